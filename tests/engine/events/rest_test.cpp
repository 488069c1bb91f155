// Equilibria and nominal sizes: what simulations start from and what their tolerances are made of.
#include "engine/events/rest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/diagram/error.h"
#include "engine/program/nominal.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

int state(const Program& program, const std::string& name) {
  for (std::size_t i = 0; i < program.state_names.size(); ++i)
    if (program.state_names[i] == name || program.state_names[i].starts_with(name + ".")) return static_cast<int>(i);
  ADD_FAILURE() << "no state " << name;
  return 0;
}

Run settled(const Program& program, double t = 0) {
  auto run = start(program);
  settle_at_rest(program, run, t);
  return run;
}

TEST(Rest, AChainOfLagsTakesTheValueOfItsInput) {
  const auto program = compiled(diagram(
      {{"u", block("constant", {{"value", "3 V"}})}, {"y", block("lag", {{"times", list({0.1, 20}, "s")}}, {"u"})}},
      {"y"}));
  const auto run = settled(*program);
  for (const double x : run.x) EXPECT_NEAR(x, 3, 1e-9);
}

TEST(Rest, TheThesisPlantShowsItsStaticGain) {
  const auto program =
      compiled(diagram({{"u", block("constant", {{"value", "2 um"}})}, {"y", thesis_plant("u")}}, {"y"}));
  const auto run = settled(*program);
  Work work(*program);
  evaluate_derivatives(*program, run, work, 0, run.x.data());
  evaluate_values(*program, run, work, 0, run.x.data());
  EXPECT_NEAR(work.y[static_cast<std::size_t>(program->signal("y"))], 2e-6 * 1.377e16 / 1.822e16, 1e-15);
}

TEST(Rest, AnIntegralControllerFindsTheCommandThatRemovesTheError) {
  // A loop: no block knows its own rest. kp e + x = r / G with e = 0.
  const auto program = compiled(diagram({{"r", block("constant", {{"value", "2 um"}})},
                                         {"e", block("sum", {{"signs", "+-"}}, {"r", "y"})},
                                         {"c", block("pi_controller", {{"kp", 1.0}, {"ki", "50 1/s"}}, {"e"})},
                                         {"y", thesis_plant("c")}},
                                        {"y"}));
  const auto run = settled(*program);
  EXPECT_NEAR(run.x[static_cast<std::size_t>(state(*program, "c"))], 2e-6 * 1.822e16 / 1.377e16, 1e-14);
}

TEST(Rest, WhatSticksRestsWhereItIsHeld) {
  // 100 N/m and a breakaway of 10 N: 5 N are held where it is, 20 N are not, and without friction it is at 0.2 m.
  for (const double force : {5.0, 20.0, -20.0}) {
    const auto program = compiled(diagram(
        {{"u", block("constant", {{"value", std::to_string(force) + " N"}})},
         {"m", block("mass_with_friction",
                     {{"mass", "1 kg"}, {"stiffness", "100 N/m"}, {"coulomb", "8 N"}, {"breakaway", "10 N"}}, {"u"})}},
        {"m.position"}));
    const auto run = settled(*program);
    EXPECT_EQ(run.x[static_cast<std::size_t>(state(*program, "m"))], std::abs(force) < 10 ? 0 : force / 100) << force;
  }
}

TEST(Rest, WhatIsDrivenAgainstItsDryFrictionMovesSteadily) {
  // A motor: w' = 4 (u - 0.1 w - 3 w - 0.8 sgn w). It turns steadily at (|u| - 0.8)/3.1 rad/s and is held up to 1 V.
  for (const double volts : {0.9, 4.0, -4.0}) {
    const auto program = compiled(diagram(
        {{"u", block("constant", {{"value", std::to_string(volts) + " V"}})},
         {"drive", block("sum", {{"signs", "+-"}}, {"u", "back"})},
         {"torque", block("gain", {{"gain", "1 N m/V"}}, {"drive"})},
         {"net", block("sum", {{"signs", "+-"}}, {"torque", "bearing"})},
         {"acceleration", block("gain", {{"gain", "4 rad/s^2/(N m)"}}, {"net"})},
         {"speed",
          block("integrator_with_friction",
                {{"level", "3.2 rad/s^2"}, {"excess", 0.25}, {"stribeck_velocity", "0.01 rad/s"}}, {"acceleration"})},
         {"bearing", block("gain", {{"gain", "3 N m s/rad"}}, {"speed"})},
         {"back", block("gain", {{"gain", "0.1 V s/rad"}}, {"speed"})}},
        {"speed"}));
    const auto run = settled(*program);
    const double expected = std::abs(volts) < 1 ? 0 : std::copysign((std::abs(volts) - 0.8) / 3.1, volts);
    EXPECT_NEAR(run.x[static_cast<std::size_t>(state(*program, "speed"))], expected, 1e-9) << volts;
    SimulateOptions options;
    options.at_rest = true;
    options.until = 2;
    options.instants = {0, 1, 2};
    options.signals = {program->signal("speed")};
    const auto traces = simulate(*program, start(*program), options);
    for (const double y : traces.values[0]) EXPECT_NEAR(y, expected, 1e-8) << volts;
  }
}

TEST(Rest, MemoryInsideALoopFollowsToItsEquilibrium) {
  // y = play(1.5 (r - y)) behind a lag, radius 0.2: rising to it, y = 1.5 (r - y) - 0.2, so y = (1.5 r - 0.2) / 2.5.
  const auto program = compiled(diagram({{"r", block("constant", {{"value", "3 V"}})},
                                         {"e", block("sum", {{"signs", "+-"}}, {"r", "y"})},
                                         {"k", block("gain", {{"gain", 1.5}}, {"e"})},
                                         {"p", block("play", {{"radius", "0.2 V"}}, {"k"})},
                                         {"y", block("lag", {{"times", list({0.01}, "s")}}, {"p"})}},
                                        {"y"}));
  const auto run = settled(*program);
  EXPECT_NEAR(run.x[0], (1.5 * 3 - 0.2) / 2.5, 1e-9);
  EXPECT_NEAR(run.m[0], run.x[0], 1e-9) << "committed";
}

TEST(Rest, WhereTheWayIsFlatBlocksBeginAtTheirOwnRest) {
  // From 0 V a follower limited to 1 V/s closes a gap of 5 V at the same rate wherever it is: no slope to go by. Behind
  // it a tank by the root of its level: 5 m^3/s of outflow at 2 m for every root of 1 m, so 2 m (5/5)^2.
  const auto program = compiled(diagram(
      {{"u", block("constant", {{"value", "5 V"}})},
       {"s", block("slew_limit", {{"rate", "1 V/s"}}, {"u"})},
       {"q", block("gain", {{"gain", "1 m^3/s/V"}}, {"s"})},
       {"h", block("tank", {{"area", "1 m^2"}, {"outlet", "5 m^3/s"}, {"reference", "2 m"}, {"law", "square_root"}},
                   {"q"})}},
      {"h.level"}));
  const auto run = settled(*program);
  EXPECT_NEAR(run.x[static_cast<std::size_t>(state(*program, "s"))], 5, 1e-9);
  EXPECT_NEAR(run.x[static_cast<std::size_t>(state(*program, "h"))], 2, 1e-9);
}

TEST(Rest, AnIntegratorWithoutInputStaysWhereItIs) {
  const auto program = compiled(diagram({{"u", block("constant", {{"value", "0 V"}})},
                                         {"x", block("integrator", {{"initial", "7 V s"}}, {"u"})},
                                         {"y", block("lag", {{"times", list({0.01}, "s")}}, {"x"})}},
                                        {"y"}));
  const auto run = settled(*program);
  EXPECT_EQ(run.x[static_cast<std::size_t>(state(*program, "x"))], 7);
  EXPECT_NEAR(run.x[static_cast<std::size_t>(state(*program, "y"))], 7, 1e-8);
}

TEST(Rest, AnIntegratorThatKeepsMovingIsNamed) {
  const auto program = compiled(diagram({{"u", block("constant", {{"value", "2 V"}})},
                                         {"x", block("integrator", {}, {"u"})},
                                         {"y", block("lag", {{"times", list({0.01}, "s")}}, {"u"})}},
                                        {"x", "y"}));
  try {
    settled(*program);
    FAIL() << "found a rest that is none";
  } catch (const Error& e) {
    EXPECT_EQ(e.fault, Fault::numerics);
    EXPECT_EQ(e.problems.front().code, "no_rest");
    EXPECT_EQ(e.problems.front().path, program->state_names[static_cast<std::size_t>(state(*program, "x"))]);
    EXPECT_NE(e.problems.front().what.find("d/dt = 2"), std::string::npos) << e.what();
    EXPECT_FALSE(e.problems.front().cure.empty());
  }
}

TEST(Rest, ALawThatIsDrivenByARateStaysWhereItIs) {
  // The sine moves at t = 0, but rest means inputs held as they are there.
  const auto program =
      compiled(diagram({{"u", block("sine", {{"amplitude", "3 V"}, {"offset", "1 V"}, {"frequency", "5 Hz"}})},
                        {"y", thesis_bouc_wen("u")},
                        {"f", block("lag", {{"times", list({0.01}, "s")}}, {"y"})}},
                       {"f"}));
  const auto run = settled(*program);
  EXPECT_EQ(run.x[static_cast<std::size_t>(state(*program, "y"))], 0);
  EXPECT_NEAR(run.x[static_cast<std::size_t>(state(*program, "f"))], 1.6126e-6, 1e-14);
}

TEST(Rest, ADeadTimeHasAlwaysSeenTheValueAtTheStart) {
  // Inside a loop: x = (r - late) / tau at rest, late = x, so x = r / 2.
  const auto program = compiled(diagram({{"r", block("constant", {{"value", "3 V"}})},
                                         {"e", block("sum", {{"signs", "+-"}}, {"r", "late"})},
                                         {"x", block("lag", {{"times", list({0.1}, "s")}}, {"e"})},
                                         {"late", block("dead_time", {{"delay", "50 ms"}}, {"x"})}},
                                        {"late"}));
  const auto run = settled(*program);
  EXPECT_NEAR(run.x[0], 1.5, 1e-9);
  ASSERT_EQ(run.histories.size(), 1U);
  EXPECT_NEAR(run.histories[0].before, 1.5, 1e-9);
  SimulateOptions options{.until = 1, .method = Method::bdf, .at_rest = true};
  const auto traces = simulate(*program, start(*program), options);
  for (const double late : trace(traces)) EXPECT_NEAR(late, 1.5, 1e-6);
}

TEST(Rest, ASimulationFromRestBeginsWithoutATransient) {
  auto d = diagram({{"y", block("lag", {{"times", list({0.1}, "s")}}, {"u"})}}, {"y"}, {{"u", "V"}});
  const auto program = compiled(d);
  auto run = start(*program);
  bind_input(*program, run, "u", series({2, 3, 4}, {5, 5, 6}));
  const auto traces = simulate(*program, run, {.begin = 2, .until = 3, .method = Method::bdf, .at_rest = true});
  for (const double y : trace(traces)) EXPECT_NEAR(y, 5, 1e-6);
}

// --- nominal sizes --------------------------------------------------------------------------------------------------

TEST(NominalStates, GrowAlongTheWiresFromTheSources) {
  const auto program = compiled(diagram({{"u", block("sine", {{"amplitude", "20 V"}, {"frequency", "5 Hz"}})},
                                         {"g", block("gain", {{"gain", "0.1 um/V"}}, {"u"})},
                                         {"y", thesis_plant("g")}},
                                        {"y"}));
  for (const double size : nominal_states(*program, start(*program))) {
    EXPECT_GT(size, 0.2e-6);  // 2 um, give or take the balancing of the states
    EXPECT_LT(size, 20e-6);
  }
}

TEST(NominalStates, AnIntegratorTakesWhatItGathersInTheTimeScaleOfTheSource) {
  // 3 um at 5 Hz for 1/(2 pi 5 Hz): 95 nm s.
  const auto program = compiled(diagram(
      {{"u", block("sine", {{"amplitude", "3 um"}, {"frequency", "5 Hz"}})}, {"y", block("integrator", {}, {"u"})}},
      {"y"}));
  const auto size = nominal_states(*program, start(*program)).front();
  EXPECT_NEAR(size, 3e-6 / (2 * std::numbers::pi * 5), 0.1 * 3e-6 / (2 * std::numbers::pi * 5));  // sampled, not solved
}

TEST(NominalStates, WithoutAnythingToGoByLengthsAreMicrometresAndTheRestIsOne) {
  const auto program = compiled(diagram({{"v", block("integrator", {}, {"a"})},
                                         {"x", block("integrator", {{"initial", "1 m"}}, {"v"})},
                                         {"a", block("gain", {{"gain", "-900 1/s^2"}}, {"x"})}},
                                        {"x"}));
  const auto sizes = nominal_states(*program, start(*program));
  EXPECT_EQ(sizes[static_cast<std::size_t>(state(*program, "x"))], 1e-6);
  EXPECT_EQ(sizes[static_cast<std::size_t>(state(*program, "v"))], 1);
}

TEST(NominalStates, ADifferenceOfEqualsIsAsLargeAsTheyAre) {
  const auto program = compiled(diagram({{"u", block("sine", {{"amplitude", "4 V"}, {"frequency", "5 Hz"}})},
                                         {"e", block("sum", {{"signs", "+-"}}, {"u", "u"})},
                                         {"y", block("lag", {{"times", list({0.1}, "s")}}, {"e"})}},
                                        {"y"}));
  EXPECT_GT(nominal_states(*program, start(*program)).front(), 3);
}

}  // namespace
}  // namespace hysteron
