#include "models/continuous/creep.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <array>
#include <cmath>
#include <vector>

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

/// Largest misfit of the best chain with these times to gamma log10(t/0.1 s), t = 0.1 ... 1000 s, as a share of the
/// step.
double log_law_misfit(const std::vector<double>& times, double gamma) {
  std::vector<double> t;
  for (double x = 0.1; x <= 1000; x *= 1.05) t.push_back(x);
  const auto rows = static_cast<Eigen::Index>(t.size()), columns = static_cast<Eigen::Index>(times.size());
  Eigen::MatrixXd a(rows, columns + 1);
  Eigen::VectorXd b(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double at = t[static_cast<std::size_t>(i)];
    b[i] = gamma * std::log10(at / 0.1);
    a(i, columns) = 1;  // the gain of the core is free
    for (Eigen::Index k = 0; k < columns; ++k) {
      const std::array<double, 1> one{1}, tau{times[static_cast<std::size_t>(k)]};
      a(i, k) = creep::step_response<double>(one, tau, at) - 1;
    }
  }
  return (a * a.colPivHouseholderQr().solve(b) - b).cwiseAbs().maxCoeff();
}

TEST(CreepModel, OneElementPerDecadeFollowsTheLogarithmicLaw) {
  // Computed independently for about 1.5 % per decade: four elements at 0.3 ... 300 s leave at
  // most 0.12 % of the step, three at 1, 10, 100 s leave 0.5 %.
  EXPECT_LT(log_law_misfit({0.3, 3, 30, 300}, 0.015), 0.0012);
  EXPECT_LT(log_law_misfit({1, 10, 100}, 0.015), 0.005);
  EXPECT_GT(log_law_misfit({1, 10, 100}, 0.015), log_law_misfit({0.3, 3, 30, 300}, 0.015));
}

/// What a chain with the amounts of logarithmic_amount() misses of log10(1 + t/first_time) for t = from ... to [s].
double missed_logarithm(const std::vector<double>& times, double first_time, double from, double to) {
  std::vector<double> amounts;
  for (std::size_t k = 0; k < times.size(); ++k)
    amounts.push_back(creep::logarithmic_amount<double>(1.0, first_time, times, k));
  double worst = 0;
  for (double t = from; t <= to; t *= 1.1) {
    const double y = creep::step_response<double>(amounts, times, t) - 1;
    worst = std::max(worst, std::abs(y - std::log10(1 + t / first_time)));
  }
  return worst;
}

TEST(CreepModel, TwoElementsPerDecadeAreTheLogarithm) {
  std::vector<double> times;
  for (int k = 0; k <= 12; ++k) times.push_back(1e-3 * std::pow(10, 0.5 * k));  // to 1000 s
  for (const double first : {3e-3, 1e-2, 0.1}) {
    // Half decades of a function that is as smooth as exp(-exp(x)): the ripple is |Gamma(2 pi i/1.15)| = 4e-4.
    EXPECT_LT(missed_logarithm(times, first, 1e-4, 1), 1e-3) << first;
    // What relaxes slower than 1000 s is missing: half a decade each of t/tau, 0.5 (0.32 + 0.1 + ...) 0.1 = 0.023.
    EXPECT_NEAR(missed_logarithm(times, first, 99, 101), 0.023, 0.001) << first;
  }
}

TEST(CreepModel, ElementsStandForTheDecadesBetweenTheirNeighbours) {
  const std::array<double, 3> times{1, 10, 1000};
  EXPECT_DOUBLE_EQ(creep::logarithmic_amount<double>(0.02, 0.0, times, 0), 0.02);
  EXPECT_DOUBLE_EQ(creep::logarithmic_amount<double>(0.02, 0.0, times, 1), 0.03);
  EXPECT_DOUBLE_EQ(creep::logarithmic_amount<double>(0.02, 0.0, times, 2), 0.04);
  EXPECT_DOUBLE_EQ(creep::logarithmic_amount<double>(0.02, 5.0, times, 1), 0.03 * std::exp(-0.5));
}

TEST(CreepModel, NothingIsAddedWhereTheAmountsAreZero) {
  const std::array<double, 1> none{0}, x{5};
  EXPECT_EQ(creep::output<double>(none, x, 1.25), 1.25);
}

}  // namespace
}  // namespace hysteron
