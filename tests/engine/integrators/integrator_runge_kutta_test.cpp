// What the explicit Runge-Kutta formula promises beyond the others: inside its steps, and behind restarts.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/engine/integrator_systems.h"

namespace hysteron {
namespace {

using namespace test;
using Outcome = Integrator::Outcome;

TEST(RungeKutta, IsAsExactInsideAStepAsAtItsEnd) {
  Integrator solver(oscillator(1), {.formula = Formula::runge_kutta, .relative_tolerance = 1e-6},
                    std::array{1e-8, 1e-8});
  solver.start(0, std::array{1.0, 0.0});
  double inside = 0, at_ends = 0;
  std::array<double, 2> x{};
  while (solver.t() < 20) {
    solver.step(20);
    at_ends = std::max(at_ends, std::abs(solver.x()[0] - std::cos(solver.t())));
    for (int k = 1; k < 16; ++k) {
      const double t = solver.previous_t() + k / 16.0 * (solver.t() - solver.previous_t());
      solver.interpolate(t, x);
      inside = std::max(inside, std::abs(x[0] - std::cos(t)));
    }
  }
  // About fifty steps of 0.4: a polynomial of degree three would be off by h^4/384 = 7e-5 in each.
  EXPECT_LT(at_ends, 2e-5);
  EXPECT_LT(inside, 1.5 * at_ends);
}

TEST(RungeKutta, TheInsideOfAStepIsOfOrderSix) {
  // Error of one step's polynomial against exp over h and h/2: 2^6 for the local error of order six.
  OdeSystem s;
  s.derivative = [](double, const double* x, double* dx) {
    dx[0] = x[0];
    return true;
  };
  const auto error = [&](double h) {
    Integrator solver(s, {.formula = Formula::runge_kutta, .relative_tolerance = 1, .max_step = h}, std::array{1.0});
    solver.start(0, std::array{1.0});
    for (int k = 1; k <= 3; ++k) {  // the first steps are ARKODE's choice: stops make them ours
      auto outcome = Outcome::step;
      while (outcome == Outcome::step) outcome = solver.step(k * h);
    }
    solver.start(1, std::array{std::exp(1.0)});
    solver.step(1 + h);
    EXPECT_EQ(solver.t(), 1 + h);
    std::array<double, 1> x{};
    double worst = 0;
    for (const double share : {0.2, 0.4, 0.5, 0.6, 0.8}) {
      solver.interpolate(1 + share * h, x);
      worst = std::max(worst, std::abs(x[0] - std::exp(1 + share * h)));
    }
    return worst;
  };
  const double ratio = error(0.5) / error(0.25);
  EXPECT_GT(ratio, 45);
  EXPECT_LT(ratio, 90);
}

TEST(RungeKutta, ASampleOfAControllerCostsOneStep) {
  // x' = -x + u, u held for 0.1 s: the step that the tolerance allows is longer. One evaluation for the new input and
  // six for the other stages; the search for a first step only at the very beginning.
  double u = 1;
  OdeSystem s;
  s.derivative = [&u](double, const double* x, double* dx) {
    dx[0] = u - x[0];
    return true;
  };
  Integrator solver(s, {.formula = Formula::runge_kutta, .relative_tolerance = 1e-6}, std::array{1e-6});
  solver.start(0, std::array{0.0});
  double exact = 0;
  long before = 0;
  for (int k = 1; k <= 100; ++k) {
    u = k % 2 == 0 ? 1 : -1;
    exact = u + (exact - u) * std::exp(-(0.1 * k - 0.1 * (k - 1)));
    while (solver.t() < 0.1 * k) solver.step(0.1 * k);
    EXPECT_NEAR(solver.x()[0], exact, 1e-5) << "ten tolerances";
    if (k == 10) before = solver.counters().evaluations;
    if (k < 100) solver.start(0.1 * k, solver.x());
  }
  EXPECT_EQ(solver.counters().evaluations - before, 90 * 7);
}

TEST(RungeKutta, BehindEachJumpItTriesWhatWorkedBehindTheLast) {
  // x' = u - x, u turned every 3 s: the steps grow towards the end of each sample, where little happens any more.
  double u = 1;
  OdeSystem s;
  s.derivative = [&u](double, const double* x, double* dx) {
    dx[0] = u - x[0];
    return true;
  };
  Integrator solver(s, {.formula = Formula::runge_kutta, .relative_tolerance = 1e-6}, std::array{1e-6});
  solver.start(0, std::array{0.0});
  double exact = 0;
  for (int k = 1; k <= 50; ++k) {
    u = -u;
    exact = u + (exact - u) * std::exp(-3.0);
    while (solver.t() < 3 * k) solver.step(3 * k);
    EXPECT_NEAR(solver.x()[0], exact, 1e-5) << "ten tolerances";
    solver.start(3 * k, solver.x());
  }
  EXPECT_LT(solver.counters().rejected, 10) << "of fifty that the last step of each sample would have cost";
}

TEST(RungeKutta, WithoutSlopesInsideAStepItsEndsHaveToDo) {
  // The stages stand at 0, 0.2, 0.3, 0.8, 8/9 and 1 of the step, dense output looks between.
  OdeSystem s;
  s.derivative = [](double t, const double*, double* dx) {
    dx[0] = 3 * t * t;  // x = t^3: of degree three
    return t < 1 || t > 2 || t < 1.31 || t > 1.79;
  };
  Integrator solver(s, {.formula = Formula::runge_kutta, .relative_tolerance = 1}, std::array{1e9});
  solver.start(-30, std::array{-27000.0});
  while (solver.t() < 1) solver.step(1);
  solver.step(2);  // as long as it may be: nothing here is an error of 1e9
  ASSERT_EQ(solver.t(), 2);
  ASSERT_EQ(solver.previous_t(), 1);
  std::array<double, 1> x{};
  solver.interpolate(1.5, x);
  EXPECT_NEAR(x[0], 1.5 * 1.5 * 1.5, 1e-10);  // rounding at 27000
}

}  // namespace
}  // namespace hysteron
