// dx/dp along a solution, by each formula.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "tests/engine/allocations.h"
#include "tests/engine/integrator_systems.h"

namespace hysteron {
namespace {

using namespace test;

using Outcome = Integrator::Outcome;

// x' = -p x with x(0) = q: dx/dp = -t q exp(-p t), dx/dq = exp(-p t).
OdeSystem decay(double p) {
  OdeSystem s;
  s.parameters = 2;
  s.derivative = [p](double, const double* x, double* dx) {
    dx[0] = -p * x[0];
    return true;
  };
  s.sensitivity_derivative = [p](double, const double* x, const double* const* s_, double* const* ds) {
    ds[0][0] = -p * s_[0][0] - x[0];
    ds[1][0] = -p * s_[1][0];
    return true;
  };
  s.jacobian = [p](double, const double*, double* entries) {
    entries[0] = -p;
    return true;
  };
  return s;
}

class SensitivitiesOfEachFormula : public testing::TestWithParam<Formula> {};
INSTANTIATE_TEST_SUITE_P(Integrator, SensitivitiesOfEachFormula,
                         testing::Values(Formula::bdf, Formula::adams, Formula::runge_kutta));

TEST_P(SensitivitiesOfEachFormula, SensitivitiesOfADecayFollowTheClosedForm) {
  const double p = 2, q = 3;
  Integrator solver(decay(p), {.formula = GetParam(), .relative_tolerance = 1e-9}, std::array{1e-12});
  solver.start(0, std::array{q}, std::array{0.0, 1.0});
  std::array<double, 2> s{};
  const auto check = [&](double t, std::span<const double> v) {
    EXPECT_NEAR(v[0], -t * q * std::exp(-p * t), 1e-6);  // as the states: some hundred tolerances
    EXPECT_NEAR(v[1], std::exp(-p * t), 1e-6);
  };
  while (solver.t() < 2) {
    solver.step(2);
    check(solver.t(), solver.sensitivities());
    const double t = (solver.t() + solver.previous_t()) / 2;
    solver.interpolate_sensitivities(t, s);
    check(t, s);
  }
  EXPECT_GT(solver.counters().sensitivity_evaluations, solver.counters().steps);
}

TEST_P(SensitivitiesOfEachFormula, SensitivitiesOfAnOscillatorToItsFrequencyGrow) {
  // x = cos(w t): dx/dw = -t sin(w t), dv/dw = -sin(w t) - w t cos(w t).
  const double w = 3;
  auto system = oscillator(w);
  system.parameters = 1;
  system.parameter_sizes = {w};
  system.sensitivity_derivative = [w](double, const double* x, const double* const* s, double* const* ds) {
    ds[0][0] = s[0][1];
    ds[0][1] = -w * w * s[0][0] - 2 * w * x[0];
    return true;
  };
  Integrator solver(system, {.formula = GetParam(), .relative_tolerance = 1e-9}, tight);
  solver.start(0, std::array{1.0, 0.0});
  while (solver.t() < 2) solver.step(2);
  EXPECT_NEAR(solver.x()[0], std::cos(2 * w), 1e-6);
  EXPECT_NEAR(solver.sensitivities()[0], -2 * std::sin(2 * w), 1e-5);  // tenfold: it is itself up to ten
  EXPECT_NEAR(solver.sensitivities()[1], -std::sin(2 * w) - 2 * w * std::cos(2 * w), 1e-5);
}

TEST_P(SensitivitiesOfEachFormula, SensitivitiesOfAChainToItsTimeConstantFollowTheClosedForm) {
  // With BDF by the sparse solver. x_(n-1) = F(t/tau) with F'(s) = s^(n-1) exp(-s)/(n-1)!, so dx/dtau = -t/tau^2 F'.
  constexpr int n = 20;
  auto system = chain_with_sparse_jacobian(n);
  system.parameters = 1;
  system.parameter_sizes = {tau};
  system.sensitivity_derivative = [](double, const double* x, const double* const* s, double* const* ds) {
    for (int i = 0; i < n; ++i) {
      const double rate = ((i == 0 ? 1.0 : x[i - 1]) - x[i]) / tau;
      ds[0][i] = ((i == 0 ? 0.0 : s[0][i - 1]) - s[0][i]) / tau - rate / tau;
    }
    return true;
  };
  Integrator solver(system, {.formula = GetParam(), .relative_tolerance = 1e-8}, std::vector<double>(n, 1e-10));
  solver.start(0, std::vector<double>(n, 0.0));
  for (const double stop : {0.5, 1.0, 1.5}) {
    while (solver.t() < stop) solver.step(stop);
    const double s = stop / tau;
    const double slope = std::exp((n - 1) * std::log(s) - s - std::lgamma(n));
    EXPECT_NEAR(solver.sensitivities()[n - 1] * tau, -s * slope, 1e-5);  // up to two: thousand tolerances
  }
}

TEST_P(SensitivitiesOfEachFormula, ARestartTakesBothStatesAndSensitivities) {
  // At t = 1 the state is halved: x and its derivatives alike.
  const double p = 2, q = 3;
  Integrator solver(decay(p), {.formula = GetParam(), .relative_tolerance = 1e-9}, std::array{1e-12});
  solver.start(0, std::array{q}, std::array{0.0, 1.0});
  while (solver.t() < 1) solver.step(1);
  const auto s = solver.sensitivities();
  const long before = allocations();
  solver.start(1, std::array{solver.x()[0] / 2}, std::array{s[0] / 2, s[1] / 2});
  while (solver.t() < 2) solver.step(2);
  EXPECT_EQ(allocations(), before);
  EXPECT_NEAR(solver.x()[0], q * std::exp(-2 * p) / 2, 1e-6);
  EXPECT_NEAR(solver.sensitivities()[0], -2 * q * std::exp(-2 * p) / 2, 1e-6);
  EXPECT_NEAR(solver.sensitivities()[1], std::exp(-2 * p) / 2, 1e-6);
}

TEST_P(SensitivitiesOfEachFormula, SensitivitiesAreThoseAtTheRoot) {
  auto system = decay(2);
  system.roots = 1;
  system.indicators = [](double, const double* x, double* g) { g[0] = x[0] - 1; };  // at t = ln(3)/2
  Integrator solver(system, {.formula = GetParam(), .relative_tolerance = 1e-9}, std::array{1e-12});
  solver.start(0, std::array{3.0}, std::array{0.0, 1.0});
  auto outcome = Outcome::step;
  while (outcome == Outcome::step) outcome = solver.step(2);
  ASSERT_EQ(outcome, Outcome::root);
  EXPECT_NEAR(solver.t(), std::log(3.0) / 2, 1e-6);
  EXPECT_NEAR(solver.sensitivities()[0], -std::log(3.0) / 2, 1e-6);
  EXPECT_NEAR(solver.sensitivities()[1], 1.0 / 3, 1e-6);
}

TEST_P(SensitivitiesOfEachFormula, ExceptionsOfTheSensitivitiesPass) {
  auto system = decay(2);
  system.sensitivity_derivative = [](double, const double*, const double* const*, double* const*) -> bool {
    throw std::out_of_range("mine");
  };
  Integrator solver(system, {.formula = GetParam()}, std::array{1e-8});
  solver.start(0, std::array{1.0});
  EXPECT_THROW(while (solver.t() < 1) solver.step(1), std::out_of_range);
}

}  // namespace
}  // namespace hysteron
