#include "engine/cvode.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "engine/error.h"

namespace hysteron {
namespace {

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

class EachFormula : public testing::TestWithParam<Formula> {};
INSTANTIATE_TEST_SUITE_P(Cvode, EachFormula, testing::Values(Formula::bdf, Formula::adams));

TEST_P(EachFormula, FollowsAnOscillatorAlsoBetweenItsSteps) {
  Cvode solver(oscillator(3), {.formula = GetParam(), .relative_tolerance = 1e-9}, tight);
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
  // The global error gathers the local ones over about one period: some hundred times the tolerance for both formulas.
  EXPECT_LT(worst, 1e-6);
  EXPECT_GT(solver.counters().steps, 10);
}

TEST_P(EachFormula, StopsExactlyAtTheStopTime) {
  Cvode solver(oscillator(1), {.formula = GetParam()}, tight);
  solver.start(0, std::array{1.0, 0.0});
  for (const double stop : {0.1, 0.1 + 1e-9, 0.7, 1.0}) {
    auto outcome = Cvode::Outcome::step;
    while (outcome == Cvode::Outcome::step) outcome = solver.step(stop);
    EXPECT_EQ(outcome, Cvode::Outcome::stop);
    EXPECT_EQ(solver.t(), stop);
  }
}

TEST(CvodeWaist, FindsFallingRootsOnly) {
  auto system = oscillator(1);
  system.roots = 1;
  system.indicators = [](double, const double* x, double* g) { g[0] = x[0]; };  // cos t: falls at pi/2, rises at 3 pi/2
  Cvode solver(system, {.relative_tolerance = 1e-10}, tight);
  solver.start(0, std::array{1.0, 0.0});
  std::vector<double> roots;
  while (solver.t() < 7) {
    if (solver.step(7) != Cvode::Outcome::root) continue;
    EXPECT_TRUE(solver.fired(0));
    roots.push_back(solver.t());
    solver.start(solver.t(), std::vector<double>(solver.x().begin(), solver.x().end()));
  }
  ASSERT_EQ(roots.size(), 1U);
  EXPECT_NEAR(roots[0], std::acos(0.0), 1e-8);
  EXPECT_EQ(solver.counters().restarts, 1);
}

TEST(CvodeWaist, CountsOverRestarts) {
  Cvode solver(oscillator(1), {}, tight);
  solver.start(0, std::array{1.0, 0.0});
  while (solver.t() < 1) solver.step(1);
  const auto first = solver.counters();
  solver.start(1, std::array{1.0, 0.0});
  while (solver.t() < 2) solver.step(2);
  EXPECT_GT(solver.counters().steps, first.steps + 5);
  EXPECT_GT(solver.counters().evaluations, first.evaluations + 5);
}

TEST(CvodeWaist, AnErrorInTheDerivativeComesBackWithWhereItHappened) {
  auto system = oscillator(1);
  system.derivative = [inner = system.derivative](double t, const double* x, double* dx) {
    if (t > 0.5) fail_numerics("loop_unsolved", "stage/gain", "the loop has no solution", "insert a lag");
    return inner(t, x, dx);
  };
  Cvode solver(system, {}, tight);
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

TEST(CvodeWaist, ForeignExceptionsPassUnchanged) {
  auto system = oscillator(1);
  system.roots = 1;
  system.indicators = [](double t, const double*, double* g) {
    if (t > 0.5) throw std::out_of_range("mine");
    g[0] = 1;
  };
  Cvode solver(system, {}, tight);
  solver.start(0, std::array{1.0, 0.0});
  EXPECT_THROW(while (solver.t() < 1) solver.step(1), std::out_of_range);
}

TEST(CvodeWaist, ADerivativeThatIsNowhereFiniteEndsWithTheNamesOfTheStates) {
  auto system = oscillator(1);
  system.derivative = [inner = system.derivative](double t, const double* x, double* dx) {
    return t <= 0.5 && inner(t, x, dx);
  };
  Cvode solver(system, {}, tight);
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
}

TEST(CvodeWaist, AFiniteEscapeTimeIsNotIntegratedForEver) {
  OdeSystem s;  // x' = x^2, x(0) = 1: infinite at t = 1
  s.derivative = [](double, const double* x, double* dx) { return std::isfinite(dx[0] = x[0] * x[0]); };
  s.state_name = [](int) { return "escape.x"; };
  Cvode solver(s, {}, std::array{1e-8});
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
