// What is kept of the past of a signal: as much as its curve takes, whatever its rates say.
#include "engine/program/histories.h"

#include <gtest/gtest.h>

#include <cmath>

#include "blocks/continuous/history.h"
#include "engine/simulate/simulate.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

/// x = integral of 5 V/s, and a dead time that reads it: the diagram's own rate of x is 5 V/s wherever x is.
ProgramPointer ramp_with_dead_time() {
  return compiled(diagram({{"one", block("constant", {{"value", "5 V/s"}})},
                           {"x", block("integrator", {}, {"one"})},
                           {"late", block("dead_time", {{"delay", "1 s"}}, {"x"})}},
                          {"late"}));
}

/// The past of x after one step from 0 s to 1 s, in which x(t) was `curve`. No usual sizes are known.
History after_one_step(double (*curve)(double t)) {
  const auto program = ramp_with_dead_time();
  auto run = start(*program);
  Work work(*program);
  const double first = curve(0), last = curve(1);
  accept(*program, run, work, 0, &first);
  Histories histories(*program, std::vector<double>(program->signals.size()), 1e-6);
  histories.fill(run, work, 0, 1, [&](double t, std::vector<double>& x) { x.front() = curve(t); });
  accept(*program, run, work, 1, &last);
  return run.histories.front();
}

TEST(Histories, AreTheCurveOfTheStatesWhereTheirRatesSayOtherwise) {
  const auto line = [](double t) { return t; };
  const auto arc = [](double t) { return std::sin(3 * t); };
  for (double (*curve)(double) : {+line, +arc}) {
    const History past = after_one_step(curve);
    EXPECT_LT(past.t.size(), 200U);
    for (const double t : {0.02, 0.31, 0.5, 0.77, 0.993})
      // The tolerance is relative to a piece's own size: of 1 at most.
      EXPECT_NEAR(blocks::history_value(past, t, t), curve(t), 2e-6) << "t = " << t;
  }
}

TEST(Histories, RefuseASignalThatMovesMoreOftenThanCanBeKept) {
  try {
    after_one_step([](double t) { return std::sin(1e9 * t); });
    ADD_FAILURE() << "should have been refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.problems.front().code, "past_too_fast");
    EXPECT_EQ(error.problems.front().path, "late");
    EXPECT_NE(error.problems.front().what.find("\"x\""), std::string::npos) << error.problems.front().what;
    EXPECT_NE(error.problems.front().what.find("t = "), std::string::npos) << error.problems.front().what;
  }
}

class PastOfAFreeMass : public testing::TestWithParam<Method> {};

// A position that begins with t^3 and has no usual size: the first steps, of first order, are straight lines whose
// slope at their end is half of the velocity there.
TEST_P(PastOfAFreeMass, FromRestIsItsMotionLater) {
  constexpr double mass = 2, lag = 0.1, delay = 0.5;
  const auto program = compiled(diagram(
      {{"f", block("step", {{"before", "0 N"}, {"after", "1 N"}, {"time", "0 s"}})},
       {"l", block("lag", {{"times", list({lag}, "s")}}, {"f"})},
       {"m", block("mass_spring_damper", {{"mass", "2 kg"}, {"damping", "0 N*s/m"}, {"stiffness", "0 N/m"}}, {"l"})},
       {"late", block("dead_time", {{"delay", "0.5 s"}}, {"m.position"})}},
      {"late"}));
  SimulateOptions options{.until = 3, .method = GetParam()};
  options.instants = {0.4, 0.51, 0.7, 1, 2, 3};
  const auto traces = simulate(*program, start(*program), options);
  for (std::size_t k = 0; k < options.instants.size(); ++k) {
    const double t = std::max(0.0, options.instants[k] - delay);
    const double position = (t * t / 2 - lag * t - lag * lag * std::expm1(-t / lag)) / mass;
    // Relative tolerance 1e-6 of at most 1.5 m, gathered over some tens of steps.
    EXPECT_NEAR(trace(traces)[k], position, 1e-5) << "t = " << options.instants[k];
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, PastOfAFreeMass, testing::Values(Method::bdf, Method::adams, Method::runge_kutta));

}  // namespace
}  // namespace hysteron
