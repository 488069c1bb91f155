#include "engine/integrators/integrator.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "engine/diagram/error.h"
#include "tests/engine/allocations.h"
#include "tests/engine/integrator_systems.h"

namespace hysteron {
namespace {

using namespace test;

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

}  // namespace
}  // namespace hysteron
