// Jacobians for backward differences: sparse, full and none.
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

class ChainOfLags : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Jacobian, ChainOfLags, testing::Values(1, 2, 5, 30));

TEST_P(ChainOfLags, SparseFullAndNoJacobianFollowTheClosedForm) {
  const int n = GetParam();
  const auto size = static_cast<std::size_t>(n);
  std::vector<Integrator::Counters> counters;
  for (const auto& system : {chain_of_lags(n), chain_with_full_jacobian(n), chain_with_sparse_jacobian(n)}) {
    Integrator solver(system, {.relative_tolerance = 1e-8}, std::vector<double>(size, 1e-10));
    solver.start(0, std::vector<double>(size, 0.0));
    while (solver.t() < 1.5) {
      solver.step(1.5);
      // BDF's global error: some hundred tolerances, as above.
      EXPECT_NEAR(solver.x()[size - 1], end_of_chain(n, solver.t()), 1e-6);
    }
    counters.push_back(solver.counters());
  }
  // An exact Jacobian of a linear system and its differences are the same but for rounding: so are the steps, nearly.
  for (const auto& c : {counters[1], counters[2]}) {
    EXPECT_NEAR(static_cast<double>(c.steps), static_cast<double>(counters[0].steps),
                0.1 * static_cast<double>(counters[0].steps));
    EXPECT_GT(c.jacobians, 0);
    EXPECT_GE(c.factorizations, c.jacobians);
    EXPECT_LE(c.evaluations + n * (counters[0].jacobians - 1), counters[0].evaluations + counters[0].evaluations / 10);
  }
  EXPECT_EQ(counters[1].steps, counters[2].steps);
}

TEST(Jacobian, APatternNeedsNoDiagonal) {
  // Twelve integrators in a row: x_i = t^(i+1)/(i+1)!. The matrix is sparse enough for KLU.
  constexpr int n = 12;
  OdeSystem s;
  s.states = n;
  s.derivative = [](double, const double* x, double* dx) {
    for (int i = 0; i < n; ++i) dx[i] = i == 0 ? 1 : x[i - 1];
    return true;
  };
  for (int column = 0; column < n; ++column) {
    s.pattern.column_begin.push_back(column);
    if (column + 1 < n) s.pattern.row.push_back(column + 1);
  }
  s.pattern.column_begin.push_back(n - 1);
  s.jacobian = [](double, const double*, double* entries) {
    std::fill_n(entries, n - 1, 1.0);
    return true;
  };
  Integrator solver(s, {.relative_tolerance = 1e-8}, std::vector<double>(n, 1e-12));
  solver.start(0, std::vector<double>(n, 0.0));
  while (solver.t() < 2) solver.step(2);
  double exact = 1;
  for (int i = 0; i < n; ++i) {
    exact *= 2.0 / (i + 1);
    EXPECT_NEAR(solver.x()[static_cast<std::size_t>(i)], exact, 1e-6 * exact + 1e-9) << "hundred tolerances";
  }
}

TEST(Jacobian, AStiffPairTakesStepsOfItsSlowPart) {
  // x' = -1e6 (x - y), y' = -y: after the start x follows y at a distance of 1e-6 y.
  OdeSystem s;
  s.states = 2;
  s.derivative = [](double, const double* x, double* dx) {
    dx[0] = -1e6 * (x[0] - x[1]);
    dx[1] = -x[1];
    return true;
  };
  s.jacobian = [](double, const double*, double* entries) {
    entries[0] = -1e6;
    entries[1] = 0;
    entries[2] = 1e6;
    entries[3] = -1;
    return true;
  };
  Integrator solver(s, {.relative_tolerance = 1e-6}, std::array{1e-9, 1e-9});
  solver.start(0, std::array{0.0, 1.0});
  while (solver.t() < 5) solver.step(5);
  EXPECT_NEAR(solver.x()[1], std::exp(-5.0), 1e-5);
  EXPECT_NEAR(solver.x()[0], std::exp(-5.0) / (1 - 1e-6), 1e-5);
  EXPECT_LT(solver.counters().steps, 500) << "the fast part alone would ask for 5e6 of an explicit formula";
}

TEST(Jacobian, ARestartWithASparseOneAllocatesNothing) {
  Integrator solver(chain_with_sparse_jacobian(30), {}, std::vector<double>(30, 1e-8));
  const std::vector<double> x(30, 0.0);
  solver.start(0, x);
  while (solver.t() < 1) solver.step(1);
  const long before = allocations();
  solver.start(1, x);
  while (solver.t() < 2) solver.step(2);
  EXPECT_EQ(allocations(), before);
}

TEST(Jacobian, ItsExceptionsPass) {
  auto system = chain_with_full_jacobian(3);
  system.jacobian = [](double, const double*, double*) -> bool { throw std::out_of_range("mine"); };
  Integrator solver(system, {}, std::vector<double>(3, 1e-8));
  solver.start(0, std::vector<double>(3, 0.0));
  EXPECT_THROW(while (solver.t() < 1) solver.step(1), std::out_of_range);
}

TEST(Jacobian, OneThatIsNotFiniteAsksForASmallerStep) {
  auto system = chain_with_full_jacobian(3);
  bool refused = false;
  system.jacobian = [&refused, inner = system.jacobian](double t, const double* x, double* entries) {
    return t > 0.5 && !refused ? !(refused = true) : inner(t, x, entries);
  };
  Integrator solver(system, {}, std::vector<double>(3, 1e-8));
  solver.start(0, std::vector<double>(3, 0.0));
  while (solver.t() < 1.5) solver.step(1.5);
  EXPECT_TRUE(refused);
  EXPECT_NEAR(solver.x()[2], end_of_chain(3, 1.5), 1e-5);
}

}  // namespace
}  // namespace hysteron
