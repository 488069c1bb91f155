#include "models/creep.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace hysteron {
namespace {

TEST(CreepModel, StepResponseIsTheSumOfTheRelaxations) {
  // Each x_k integrated by Runge-Kutta must give c_k (1 - exp(-t/tau_k)).
  const std::array<double, 2> c{0.1, 0.02}, tau{0.5, 3.0};
  std::array<double, 2> x{0, 0};
  const double h = 0.01;
  for (int i = 0; i < 100; ++i)
    for (std::size_t k = 0; k < 2; ++k) {
      const double k1 = creep::relaxation_rate(tau[k], x[k], 1.0);
      const double k2 = creep::relaxation_rate(tau[k], x[k] + h / 2 * k1, 1.0);
      const double k3 = creep::relaxation_rate(tau[k], x[k] + h / 2 * k2, 1.0);
      const double k4 = creep::relaxation_rate(tau[k], x[k] + h * k3, 1.0);
      x[k] += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
  // Runge-Kutta error over one second at h/tau = 0.02: (0.02)^4/120 * 2 = 3e-9, times 0.1.
  EXPECT_NEAR(creep::output<double>(c, x, 1.0), creep::step_response<double>(c, tau, 1.0), 1e-9);
}

TEST(CreepModel, EqualAmountsADecadeApartCreepLogarithmically) {
  // EFFECTS creep: one element per decade at 0.3, 3, 30, 300 s with equal amounts follows
  // L(0.1 s) (1 + gamma log10(t/0.1 s)) within 0.12 % of the step over 0.1 ... 1000 s for gamma around 1.5 %.
  const double gamma = 0.015;
  const std::array<double, 4> c{gamma, gamma, gamma, gamma}, tau{0.3, 3, 30, 300};
  const double first = creep::step_response<double>(c, tau, 0.1);
  // The amounts come on top of the step, the law counts from 0.1 s: the offset at 0.1 s is theirs.
  double worst = 0;
  for (double t = 0.1; t <= 1000; t *= 1.1)
    worst = std::max(worst, std::fabs(creep::step_response<double>(c, tau, t) - first - gamma * std::log10(t / 0.1)));
  EXPECT_LT(worst, 0.008);  // without a free offset and scale: half a decade's amount
}

TEST(CreepModel, NothingIsAddedWhereTheAmountsAreZero) {
  const std::array<double, 1> none{0}, x{5};
  EXPECT_EQ(creep::output<double>(none, x, 1.25), 1.25);
}

}  // namespace
}  // namespace hysteron
