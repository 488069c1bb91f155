#include "engine/integrator.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "engine/error.h"
#include "tests/engine/allocations.h"

namespace hysteron {
namespace {

constexpr double pi = std::numbers::pi;

OdeSystem oscillator(double omega) {
  OdeSystem s;
  s.states = 2;
  s.derivative = [omega](double, const double* x, double* dx) {
    dx[0] = x[1];
    dx[1] = -omega * omega * x[0];
    return true;
  };
  s.state_name = [](int i) { return i == 0 ? "mass.x" : "mass.v"; };
  return s;
}

const std::array<double, 2> tight{1e-12, 1e-12};

using Outcome = Integrator::Outcome;

class EachFormula : public testing::TestWithParam<Formula> {};
INSTANTIATE_TEST_SUITE_P(Integrator, EachFormula, testing::Values(Formula::bdf, Formula::adams, Formula::runge_kutta));

TEST_P(EachFormula, FollowsAnOscillatorAlsoBetweenItsSteps) {
  Integrator solver(oscillator(3), {.formula = GetParam(), .relative_tolerance = 1e-9}, tight);
  solver.start(0, std::array{1.0, 0.0});
  double worst = 0;
  std::array<double, 2> x{};
  while (solver.t() < 2) {
    solver.step(2);
    for (const double share : {0.25, 0.5, 0.75}) {
      const double t = solver.previous_t() + share * (solver.t() - solver.previous_t());
      solver.interpolate(t, x);
      worst = std::max(worst, std::abs(x[0] - std::cos(3 * t)));
    }
  }
  EXPECT_EQ(solver.t(), 2);
  // The global error gathers the local ones over about one period: some hundred times the tolerance for all formulas.
  EXPECT_LT(worst, 1e-6);
  EXPECT_GT(solver.counters().steps, 10);
}

TEST_P(EachFormula, StopsExactlyAtTheStopTime) {
  Integrator solver(oscillator(1), {.formula = GetParam()}, tight);
  solver.start(0, std::array{1.0, 0.0});
  for (const double stop : {0.1, 0.1 + 1e-9, 0.7, 1.0}) {
    auto outcome = Outcome::step;
    while (outcome == Outcome::step) outcome = solver.step(stop);
    EXPECT_EQ(outcome, Outcome::stop);
    EXPECT_EQ(solver.t(), stop);
  }
}

TEST_P(EachFormula, StopsExactlyAlsoWhereARestartStandsRightBeforeTheStop) {
  // Sampled inputs: the step that suits the equations is far longer than the next interval.
  Integrator solver(oscillator(1), {.formula = GetParam(), .relative_tolerance = 1e-3}, std::array{1e-3, 1e-3});
  solver.start(0, std::array{1.0, 0.0});
  for (const double stop : {3.0, 3.0 + 1e-7, 3.0 + 2e-7, 3.1, 6.0}) {
    auto outcome = Outcome::step;
    while (outcome == Outcome::step) {
      outcome = solver.step(stop);
      ASSERT_LE(solver.t(), stop);
    }
    EXPECT_EQ(solver.t(), stop);
    solver.start(solver.t(), solver.x());
  }
  EXPECT_NEAR(solver.x()[0], std::cos(6.0), 0.1);  // some ten times the tolerance per radian
}

TEST_P(EachFormula, FindsFallingRootsOnly) {
  auto system = oscillator(1);
  system.roots = 1;
  system.indicators = [](double, const double* x, double* g) { g[0] = x[0]; };  // cos t: falls at pi/2, rises at 3 pi/2
  for (const bool restart : {true, false}) {
    Integrator solver(system, {.formula = GetParam(), .relative_tolerance = 1e-10}, tight);
    solver.start(0, std::array{1.0, 0.0});
    std::vector<double> roots;
    while (solver.t() < 9) {
      if (solver.step(9) != Outcome::root) continue;
      EXPECT_TRUE(solver.fired(0));
      EXPECT_NEAR(solver.x()[0], 0, 100 * 10 * 2.3e-16);  // a hundred roundings of t, slope one
      roots.push_back(solver.t());
      if (restart) solver.start(solver.t(), std::vector<double>(solver.x().begin(), solver.x().end()));
    }
    ASSERT_EQ(roots.size(), 2U);
    // Slope one there: off by as much as the states are.
    EXPECT_NEAR(roots[0], pi / 2, 1e-8);
    EXPECT_NEAR(roots[1], 5 * pi / 2, 1e-7);
    EXPECT_EQ(solver.counters().restarts, restart ? 2 : 0);
  }
}

TEST_P(EachFormula, OfTwoRootsInOneStepTheEarlierComesFirst) {
  OdeSystem s;  // x' = 1: any step is exact, and all of them are long
  s.roots = 3;
  s.derivative = [](double, const double*, double* dx) {
    dx[0] = 1;
    return true;
  };
  s.indicators = [](double, const double* x, double* g) {
    g[0] = 0.7 - x[0];
    g[1] = 1e6 * std::pow(0.6 - x[0], 3);  // flat where it falls
    g[2] = x[0] - 0.5;                     // rises
  };
  Integrator solver(s, {.formula = GetParam()}, std::array{1e-6});
  solver.start(0, std::array{0.0});
  std::vector<std::pair<int, double>> fired;
  while (solver.t() < 1) {
    if (solver.step(1) != Outcome::root) continue;
    for (int i = 0; i < 3; ++i)
      if (solver.fired(i)) fired.emplace_back(i, solver.t());
  }
  ASSERT_EQ(fired.size(), 2U);
  EXPECT_EQ(fired[0].first, 1);
  EXPECT_NEAR(fired[0].second, 0.6, 1e-12);
  EXPECT_EQ(fired[1].first, 0);
  EXPECT_NEAR(fired[1].second, 0.7, 1e-12);
}

TEST_P(EachFormula, WhatFallsAtOneInstantFiresTogether) {
  auto system = oscillator(1);
  system.roots = 2;
  system.indicators = [](double, const double* x, double* g) {
    g[0] = x[0];
    g[1] = 1e-3 * x[0];
  };
  Integrator solver(system, {.formula = GetParam()}, tight);
  solver.start(0, std::array{1.0, 0.0});
  auto outcome = Outcome::step;
  while (outcome == Outcome::step) outcome = solver.step(3);
  ASSERT_EQ(outcome, Outcome::root);
  EXPECT_TRUE(solver.fired(0));
  EXPECT_TRUE(solver.fired(1));
}

TEST_P(EachFormula, CountsOverRestarts) {
  Integrator solver(oscillator(1), {.formula = GetParam()}, tight);
  solver.start(0, std::array{1.0, 0.0});
  while (solver.t() < 1) solver.step(1);
  const auto first = solver.counters();
  solver.start(1, std::array{1.0, 0.0});
  while (solver.t() < 2) solver.step(2);
  const auto both = solver.counters();
  EXPECT_GT(both.steps, first.steps + 2);
  EXPECT_GT(both.evaluations, first.evaluations + 5);
  EXPECT_EQ(both.restarts, 1);
  if (GetParam() == Formula::bdf) {
    EXPECT_GT(both.jacobians, first.jacobians);
    EXPECT_GE(both.factorizations, both.jacobians);
  } else {
    EXPECT_EQ(both.jacobians, 0);
    EXPECT_EQ(both.factorizations, 0);
  }
}

TEST_P(EachFormula, CountsEveryEvaluationAndWhatWasRejected) {
  long evaluations = 0;
  OdeSystem s;  // rests, then jumps: the step that finds the jump is too long
  s.roots = 1;
  s.derivative = [&](double t, const double* x, double* dx) {
    ++evaluations;
    dx[0] = t < 1 ? 0 : 100 * std::cos(100 * t) - 10 * x[0];
    return true;
  };
  s.indicators = [&](double, const double*, double* g) {
    ++evaluations;
    g[0] = 1;
  };
  Integrator solver(s, {.formula = GetParam()}, std::array{1e-8});
  solver.start(0, std::array{0.0});
  std::array<double, 1> x{};
  while (solver.t() < 2) {
    solver.step(2);
    solver.interpolate(solver.previous_t(), x);
  }
  EXPECT_EQ(solver.counters().evaluations, evaluations);
  EXPECT_GT(solver.counters().rejected, 0);
}

TEST_P(EachFormula, ARestartAllocatesNothing) {
  auto system = oscillator(1);
  system.jacobian = [](double, const double*, double* entries) {
    entries[0] = entries[3] = 0;
    entries[1] = -1;
    entries[2] = 1;
    return true;
  };
  Integrator solver(system, {.formula = GetParam()}, tight);
  solver.start(0, std::array{1.0, 0.0});
  while (solver.t() < 1) solver.step(1);
  const std::array x{1.0, 0.0};
  std::array<double, 2> between{};
  const long before = allocations();
  solver.start(1, x);
  while (solver.t() < 2) {
    solver.step(2);
    solver.interpolate(solver.previous_t(), between);
  }
  EXPECT_EQ(allocations(), before);
}

TEST_P(EachFormula, AnErrorInTheDerivativeComesBackWithWhereItHappened) {
  auto system = oscillator(1);
  system.derivative = [inner = system.derivative](double t, const double* x, double* dx) {
    if (t > 0.5) fail_numerics("loop_unsolved", "stage/gain", "the loop has no solution", "insert a lag");
    return inner(t, x, dx);
  };
  Integrator solver(system, {.formula = GetParam()}, tight);
  solver.start(0, std::array{1.0, 0.0});
  try {
    while (solver.t() < 1) solver.step(1);
    FAIL() << "the error was lost";
  } catch (const Error& e) {
    EXPECT_EQ(e.fault, Fault::numerics);
    EXPECT_EQ(e.problems.front().code, "loop_unsolved");
    EXPECT_EQ(e.problems.front().path, "stage/gain");
    EXPECT_NE(e.problems.front().what.find("t = 0."), std::string::npos) << e.what();
    EXPECT_NE(e.problems.front().what.find("mass.x"), std::string::npos) << e.what();
    EXPECT_EQ(e.problems.front().cure, "insert a lag");
  }
}

TEST_P(EachFormula, AnErrorInTheFirstEvaluationHasNoStepToTellOf) {
  auto system = oscillator(1);
  system.derivative = [](double, const double*, double*) -> bool {
    fail_numerics("loop_unsolved", "stage/gain", "the loop has no solution", "insert a lag");
  };
  Integrator solver(system, {.formula = GetParam()}, tight);
  solver.start(0, std::array{1.0, 0.0});
  try {
    solver.step(1);
    FAIL() << "the error was lost";
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().code, "loop_unsolved");
    EXPECT_NE(e.problems.front().what.find("t = 0 s"), std::string::npos) << e.what();
    EXPECT_EQ(e.problems.front().what.find("tolerances"), std::string::npos) << e.what();
  }
}

TEST_P(EachFormula, MayBeStartedAgainBeforeAnyStep) {
  Integrator solver(oscillator(1), {.formula = GetParam(), .relative_tolerance = 1e-9}, tight);
  solver.start(-5, std::array{0.0, 7.0});
  solver.start(0, std::array{1.0, 0.0});
  while (solver.t() < 1) solver.step(1);
  EXPECT_NEAR(solver.x()[0], std::cos(1.0), 1e-6);
}

TEST_P(EachFormula, ForeignExceptionsPassUnchanged) {
  auto system = oscillator(1);
  system.roots = 1;
  system.indicators = [](double t, const double*, double* g) {
    if (t > 0.5) throw std::out_of_range("mine");
    g[0] = 1;
  };
  Integrator solver(system, {.formula = GetParam()}, tight);
  solver.start(0, std::array{1.0, 0.0});
  EXPECT_THROW(while (solver.t() < 1) solver.step(1), std::out_of_range);
}

TEST_P(EachFormula, ADerivativeThatIsNowhereFiniteEndsWithTheNamesOfTheStates) {
  auto system = oscillator(1);
  system.derivative = [inner = system.derivative](double t, const double* x, double* dx) {
    return t <= 0.5 && inner(t, x, dx);
  };
  Integrator solver(system, {.formula = GetParam()}, tight);
  solver.start(0, std::array{1.0, 0.0});
  try {
    while (solver.t() < 1) solver.step(1);
    FAIL() << "went through a region without derivative";
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().code, "step_too_small") << "it creeps up to the edge";
    EXPECT_NE(e.problems.front().what.find("mass.v"), std::string::npos) << e.what();
    EXPECT_FALSE(e.problems.front().cure.empty());
  }
  EXPECT_LE(solver.t(), 0.5);
  EXPECT_NEAR(solver.t(), 0.5, 1e-9);
}

TEST_P(EachFormula, ADerivativeThatIsNotFiniteInPlacesCostsSmallerStepsOnly) {
  OdeSystem s;  // x' = -1/(2x): x = sqrt(1 - t), which a long step overshoots
  s.derivative = [](double, const double* x, double* dx) {
    dx[0] = -0.5 / x[0];
    return x[0] > 0;
  };
  Integrator solver(s, {.formula = GetParam(), .relative_tolerance = 1e-8}, std::array{1e-10});
  solver.start(0, std::array{1.0});
  while (solver.t() < 0.9999) solver.step(0.9999);
  // An error dx made early is dx / x(t) later, a hundredfold here; some hundred times the tolerance by itself.
  EXPECT_NEAR(solver.x()[0], 0.01, 1e-4);
}

TEST_P(EachFormula, AFiniteEscapeTimeIsNotIntegratedForEver) {
  OdeSystem s;  // x' = x^2, x(0) = 1: infinite at t = 1
  s.derivative = [](double, const double* x, double* dx) { return std::isfinite(dx[0] = x[0] * x[0]); };
  s.state_name = [](int) { return "escape.x"; };
  Integrator solver(s, {.formula = GetParam()}, std::array{1e-8});
  solver.start(0, std::array{1.0});
  try {
    for (int i = 0; i < 100'000 && solver.t() < 2; ++i) solver.step(2);
    FAIL() << "passed the pole, t = " << solver.t();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("escape.x"), std::string::npos) << e.what();
  }
  EXPECT_NEAR(solver.t(), 1, 1e-3);
}

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

// x_i' = (x_(i-1) - x_i)/tau, x_(-1) = 1: x_(n-1)(t) = 1 - exp(-t/tau) sum_(k<n) (t/tau)^k/k!.
constexpr double tau = 0.05;
OdeSystem chain_of_lags(int n) {
  OdeSystem s;
  s.states = n;
  s.derivative = [n](double, const double* x, double* dx) {
    for (int i = 0; i < n; ++i) dx[i] = ((i == 0 ? 1.0 : x[i - 1]) - x[i]) / tau;
    return true;
  };
  return s;
}
double end_of_chain(int n, double t) {
  double sum = 0, term = 1;
  for (int k = 0; k < n; ++k) {
    sum += term;
    term *= t / tau / (k + 1);
  }
  return 1 - std::exp(-t / tau) * sum;
}

OdeSystem chain_with_sparse_jacobian(int n) {
  auto s = chain_of_lags(n);
  for (int column = 0; column < n; ++column) {
    s.pattern.column_begin.push_back(static_cast<int>(s.pattern.row.size()));
    s.pattern.row.push_back(column);
    if (column + 1 < n) s.pattern.row.push_back(column + 1);
  }
  s.pattern.column_begin.push_back(static_cast<int>(s.pattern.row.size()));
  s.jacobian = [n](double, const double*, double* entries) {
    for (int k = 0; k < 2 * n - 1; ++k) entries[k] = k % 2 == 0 ? -1 / tau : 1 / tau;
    return true;
  };
  return s;
}
OdeSystem chain_with_full_jacobian(int n) {
  auto s = chain_of_lags(n);
  s.jacobian = [n](double, const double*, double* entries) {
    for (int column = 0; column < n; ++column)
      for (int row = 0; row < n; ++row)
        entries[column * n + row] = row == column ? -1 / tau : row == column + 1 ? 1 / tau : 0;
    return true;
  };
  return s;
}

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

TEST_P(EachFormula, SensitivitiesOfADecayFollowTheClosedForm) {
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

TEST_P(EachFormula, SensitivitiesOfAnOscillatorToItsFrequencyGrow) {
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

TEST_P(EachFormula, SensitivitiesOfAChainToItsTimeConstantFollowTheClosedForm) {
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

TEST_P(EachFormula, ARestartTakesBothStatesAndSensitivities) {
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

TEST_P(EachFormula, SensitivitiesAreThoseAtTheRoot) {
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

TEST_P(EachFormula, ExceptionsOfTheSensitivitiesPass) {
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
