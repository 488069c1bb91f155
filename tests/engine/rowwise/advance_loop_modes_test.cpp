// Feedback loops whose blocks change their modes, row by row: against the integrator, which finds every change on its
// own, and closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/rowwise/advance.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;
using Blocks = std::vector<std::pair<std::string, Node>>;
using Values = std::vector<std::vector<double>>;

SeriesPointer voltage(double until, int rows, double size, double slow, double fast) {
  const auto t = grid(0, until, rows);
  std::vector<double> v;
  for (const double s : t) v.push_back(size * (std::sin(slow * s) + 0.4 * std::sin(fast * s)));
  return series(t, v, Between::linear);
}

/// Row by row, whatever the diagram says of methods.
Values by_rows(const Blocks& blocks, const std::vector<std::string>& record, const SeriesPointer& u, int substeps,
               bool at_rest = false) {
  const auto program = compiled(diagram(blocks, record, {{"u", "V"}}));
  EXPECT_EQ(why_not_exact(*program), "");
  auto run = start(*program);
  bind_input(*program, run, "u", u);
  Values result;
  Advance(program, program->record_signals)(run, u->t, {.substeps = substeps, .at_rest = at_rest}, result);
  return result;
}

Values by_integrator(const Blocks& blocks, const std::vector<std::string>& record, const SeriesPointer& u,
                     bool at_rest = false) {
  const auto program = compiled(diagram(blocks, record, {{"u", "V"}}));
  auto run = start(*program);
  bind_input(*program, run, "u", u);
  SimulateOptions options{.method = Method::bdf, .relative_tolerance = 1e-10, .at_rest = at_rest};
  options.instants = u->t;
  return simulate(*program, run, options).values;
}

/// A motor whose winding sees its speed, with dry friction in its bearings.
Blocks motor(double coulomb, double excess, double back_emf) {
  return {{"voltage", block("sum", {{"signs", "+-"}}, {"u", "back"})},
          {"winding", block("lag", {{"times", list({0.004}, "s")}}, {"voltage"})},
          {"torque", block("gain", {{"gain", number(0.025, "N m/V")}}, {"winding"})},
          {"rotor", block("inertia_with_friction",
                          {{"inertia", number(2e-5, "kg m^2")},
                           {"damping", number(1e-5, "N m s")},
                           {"coulomb", number(coulomb, "N m")},
                           {"breakaway", number(coulomb * (1 + excess), "N m")},
                           {"stribeck_velocity", number(3, "rad/s")}},
                          {"torque"})},
          {"back", block("gain", {{"gain", number(back_emf, "V s")}}, {"rotor.velocity"})}};
}

TEST(AdvanceLoopModes, FrictionOfMotorsAgreesWithTheIntegrator) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < 12; ++i) {
    const double coulomb = 0.004 + 0.02 * share(random), excess = i % 3 == 0 ? 0 : share(random);
    const auto blocks = motor(coulomb, excess, 0.02 + 0.05 * share(random));
    const auto u = voltage(1.0, 1000, 1 + 3 * share(random), 10 + 10 * share(random), 40 + 20 * share(random));
    const auto exact = by_integrator(blocks, {"rotor.velocity", "winding"}, u);
    SCOPED_TRACE(i);
    // Rows of a quarter of the electrical time constant, in which Runge-Kutta is off by (1/4)^5/120 = 8e-6 of it;
    // friction that falls with the speed makes a hundred times as much of an error where it begins to slide. In eighths
    // of a row 8^4 times less.
    const double rows = relative_distance(by_rows(blocks, {"rotor.velocity", "winding"}, u, 1), exact);
    const double finer = relative_distance(by_rows(blocks, {"rotor.velocity", "winding"}, u, 8), exact);
    EXPECT_LT(rows, 2e-3);
    EXPECT_LT(finer, 2e-6);  // 2e-3/8^4 = 5e-7, and what BDF is off by, a thousand of its tolerances
  }
}

TEST(AdvanceLoopModes, AServoSticksWhereItIsHeld) {
  // A proportional loop pulls with k e: once at rest it stays within breakaway/k of where it was sent.
  const Blocks blocks{
      {"target", block("gain", {{"gain", number(1e-3, "m/V")}}, {"u"})},
      {"e", block("sum", {{"signs", "+-"}}, {"target", "m.position"})},
      {"pull", block("gain", {{"gain", number(1000, "N/m")}}, {"e"})},
      {"m",
       block("mass_with_friction",
             {{"mass", number(0.1, "kg")}, {"damping", number(6, "N s/m")}, {"coulomb", number(0.5, "N")}}, {"pull"})}};
  const auto t = grid(0, 1, 500);
  std::vector<double> v;
  for (const double s : t) v.push_back(s < 0.2 ? 0.0 : std::min(1.0, (s - 0.2) / 0.05) * 3);
  const auto u = series(t, v, Between::linear);
  const auto rows = by_rows(blocks, {"m.position", "m.velocity"}, u, 4);
  // Quarters of rows of 2 ms in a loop of 100 rad/s: (1/20)^5/120 = 3e-9 a step, some hundred steps.
  EXPECT_LT(relative_distance(rows, by_integrator(blocks, {"m.position", "m.velocity"}, u)), 1e-6);
  EXPECT_EQ(rows[1].back(), 0.0);
  EXPECT_EQ(rows[0].back(), rows[0][rows[0].size() - 50]);
  EXPECT_LT(std::abs(rows[0].back() - 3e-3), 0.5e-3);
}

TEST(AdvanceLoopModes, JumpsOfTheInputBreakItAway) {
  auto blocks = motor(0.01, 0.5, 0.04);
  const auto t = grid(0, 0.6, 300);
  std::vector<double> v;
  for (const double s : t) v.push_back(std::fmod(s, 0.2) < 0.1 ? 1.5 : -0.3);
  const auto u = series(t, v, Between::hold);
  const std::vector<std::string> seen{"rotor.velocity", "rotor.angle"};
  // Steps of 1/32 of the electrical time constant: 3e-10 each; as above for the rest.
  EXPECT_LT(relative_distance(by_rows(blocks, seen, u, 16), by_integrator(blocks, seen, u)), 2e-6);
}

TEST(AdvanceLoopModes, ALevelThatIsControlledMeetsTheBrim) {
  // The pump gives at most what the limit allows; the integral of the controller stands at its limits.
  const Blocks blocks{
      {"wanted", block("gain", {{"gain", number(0.1, "m/V")}}, {"u"})},
      {"e", block("sum", {{"signs", "+-"}}, {"wanted", "tank.level"})},
      {"integral",
       block("limited_integrator",
             {{"lower", number(0, "m s")}, {"upper", number(0.4, "m s")}, {"initial", number(0, "m s")}}, {"e"})},
      {"flow", block("gain", {{"gain", number(2e-4, "m^2/s^2")}}, {"integral"})},
      {"more", block("gain", {{"gain", number(3e-4, "m^2/s")}}, {"e"})},
      {"in", block("sum", {{"signs", "++"}}, {"flow", "more"})},
      {"tank", block("tank",
                     {{"area", number(0.01, "m^2")},
                      {"outlet", number(3e-5, "m^3/s")},
                      {"reference", number(0.1, "m")},
                      {"brim", number(0.25, "m")},
                      {"initial", number(0.1, "m")}},
                     {"in"})}};
  const auto u = voltage(600, 1200, 2, 0.02, 0.05);
  const std::vector<std::string> seen{"tank.level", "integral"};
  const auto rows = by_rows(blocks, seen, u, 4);
  // Eighths of a second in a loop of 30 s: nothing is left of Runge-Kutta but the tolerance of BDF, a thousand times.
  EXPECT_LT(relative_distance(rows, by_integrator(blocks, seen, u)), 1e-6);
  EXPECT_NEAR(largest(rows[0]), 0.25, 1e-9) << "it does not reach the brim";
  EXPECT_NEAR(largest(rows[1]), 0.4, 1e-9) << "the integral does not reach its limit";
  EXPECT_EQ(*std::min_element(rows[1].begin() + 100, rows[1].end()), 0) << "nor the other one";
}

TEST(AdvanceLoopModes, TheSameRowByRowAndManyAtOnce) {
  // A sampled block that never runs: point by point.
  auto blocks = motor(0.01, 0.5, 0.04);
  const auto u = voltage(1.0, 700, 3, 12, 50);
  const auto fast = by_rows(blocks, {"rotor.velocity"}, u, 2);
  blocks.push_back({"never", block("sample_hold", {{"period", "1 s"}, {"offset", "1000 s"}}, {"u"})});
  const auto slow = by_rows(blocks, {"rotor.velocity", "never"}, u, 2);
  EXPECT_LT(distance(fast[0], slow[0]), 1e-12 * largest(fast[0]));
}

TEST(AdvanceLoopModes, WhatJumpsBesideARateIndependentLawIsLeftToTheIntegrator) {
  const Blocks blocks{
      {"e", block("sum", {{"signs", "+-"}}, {"u", "back"})},
      {"law", thesis_bouc_wen("e")},
      {"pull", block("gain", {{"gain", number(1, "N/um")}}, {"law"})},
      {"m",
       block("mass_with_friction",
             {{"mass", number(0.1, "kg")}, {"damping", number(6, "N s/m")}, {"coulomb", number(0.5, "N")}}, {"pull"})},
      {"back", block("gain", {{"gain", number(1, "V/mm")}}, {"m.position"})}};
  const auto why = why_not_exact(*compiled(diagram(blocks, {"m.position"}, {{"u", "V"}})));
  EXPECT_NE(why.find("mass_with_friction \"m\" changes its mode at events and stands in a feedback loop"),
            std::string::npos)
      << why;
}

}  // namespace
}  // namespace hysteron
