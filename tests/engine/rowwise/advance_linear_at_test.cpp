// Blocks that are linear at their numbers though not in general, row by row: a gear without play, a controller without
// limits; and loops of linear blocks around bent ones.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/rowwise/advance.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;
using Blocks = std::vector<std::pair<std::string, Node>>;
using Values = std::vector<std::vector<double>>;

SeriesPointer drive(double until, int rows) {
  const auto t = grid(0, until, rows);
  std::vector<double> v;
  for (const double s : t) v.push_back(std::sin(9 * s) + 0.4 * std::sin(35 * s));
  return series(t, v, Between::linear);
}

struct Rows {
  ProgramPointer program;
  Run run;
  SeriesPointer u;

  Rows(const Blocks& blocks, const std::vector<std::string>& record, SeriesPointer input)
      : program(compiled(diagram(blocks, record, {{"u", "V"}}))), run(start(*program)), u(std::move(input)) {
    bind_input(*program, run, "u", u);
  }
  void set(const std::string& parameter, double si) { set_parameter(*program, run, parameter, si); }
  /// As runs of a fit do that is free to move it.
  void vary(const std::string& parameter) {
    for (const auto& p : program->parameters)
      if (p.path == parameter) run.varied.insert(run.varied.end(), p.slots.begin(), p.slots.end());
    EXPECT_FALSE(run.varied.empty());
  }
  Values values(int substeps = 1) const {
    Values result;
    Advance(program, program->record_signals)(run, u->t, {.substeps = substeps}, result);
    return result;
  }
};

Blocks table_behind_gear() {
  return {
      {"motor", block("gain", {{"gain", number(0.02, "N m/V")}}, {"u"})},
      {"net", block("sum", {{"signs", "+-"}}, {"motor", "gear.torque_in"})},
      {"rotor", block("inertia", {{"inertia", number(2e-5, "kg m^2")}, {"damping", number(1e-4, "N m s")}}, {"net"})},
      {"gear", block("gear", {{"ratio", 18.0}, {"stiffness", number(80, "N m")}, {"damping", number(0.05, "N m s")}},
                     {"rotor.angle", "rotor.velocity", "table.angle", "table.velocity"})},
      {"table", block("inertia", {{"inertia", number(0.015, "kg m^2")}, {"damping", number(0.09, "N m s")}},
                      {"gear.torque_out"})}};
}

/// The same, the gear drawn.
Blocks table_behind_drawn_gear() {
  auto blocks = table_behind_gear();
  blocks[1].second = block("sum", {{"signs", "+-"}}, {"motor", "felt"});
  blocks[4].second =
      block("inertia", {{"inertia", number(0.015, "kg m^2")}, {"damping", number(0.09, "N m s")}}, {"torque"});
  blocks.erase(blocks.begin() + 3);
  const Blocks gear{{"ahead", block("gain", {{"gain", 1 / 18.0}}, {"rotor.angle"})},
                    {"twist", block("sum", {{"signs", "+-"}}, {"ahead", "table.angle"})},
                    {"faster", block("gain", {{"gain", 1 / 18.0}}, {"rotor.velocity"})},
                    {"rate", block("sum", {{"signs", "+-"}}, {"faster", "table.velocity"})},
                    {"spring", block("gain", {{"gain", number(80, "N m")}}, {"twist"})},
                    {"damper", block("gain", {{"gain", number(0.05, "N m s")}}, {"rate"})},
                    {"torque", block("sum", {{"signs", "++"}}, {"spring", "damper"})},
                    {"felt", block("gain", {{"gain", 1 / 18.0}}, {"torque"})}};
  blocks.insert(blocks.end(), gear.begin(), gear.end());
  return blocks;
}

const std::vector<std::string> speeds{"rotor.velocity", "table.velocity"};

TEST(AdvanceLinearAt, AGearWithoutPlayIsTheLinearOneThatIsDrawn) {
  const auto u = drive(1, 400);
  // Matrix exponentials of the same matrices but for rounding.
  EXPECT_LT(relative_distance(Rows(table_behind_gear(), speeds, u).values(),
                              Rows(table_behind_drawn_gear(), speeds, u).values()),
            1e-11);
}

TEST(AdvanceLinearAt, WithPlayOrLossesItIsNot) {
  const auto u = drive(1, 400);
  const auto linear = Rows(table_behind_drawn_gear(), speeds, u).values();
  for (const auto& [parameter, value] : {std::pair{"gear.gap", 0.02}, std::pair{"gear.efficiency", 0.8}}) {
    Rows other(table_behind_gear(), speeds, u);
    other.set(parameter, value);
    EXPECT_GT(relative_distance(other.values(16), linear), 1e-2) << parameter;
  }
}

TEST(AdvanceLinearAt, WhatAFitMayMoveIsComputedAlikeOnBothSides) {
  const auto u = drive(1, 200);
  const auto at = [&](double efficiency, bool varied) {
    Rows rows(table_behind_gear(), speeds, u);
    rows.set("gear.efficiency", efficiency);
    if (varied) rows.vary("gear.efficiency");
    return rows.values();
  };
  // By steps that take what decays exactly, or as a linear system; a loss of 1e-12 moves nothing.
  EXPECT_LT(relative_distance(at(1, true), at(1 - 1e-12, true)), 1e-10);
  EXPECT_LT(relative_distance(at(1, false), at(1 - 1e-12, true)), 1e-10);
}

TEST(AdvanceLinearAt, AControllerWithoutLimitsIsLinear) {
  const std::pair<std::string, Node> plant{
      "x", block("second_order", {{"frequency", number(8, "Hz")}, {"damping", 0.3}}, {"c"})};
  const Blocks pid{plant, {"c", block("pid", {{"kp", 0.8}, {"ki", number(6, "1/s")}}, {"u", "x"})}};
  const Blocks drawn{plant,
                     {"e", block("sum", {{"signs", "+-"}}, {"u", "x"})},
                     {"p", block("gain", {{"gain", 0.8}}, {"e"})},
                     {"k", block("gain", {{"gain", number(6, "1/s")}}, {"e"})},
                     {"i", block("integrator", {}, {"k"})},
                     {"c", block("sum", {{"signs", "++"}}, {"p", "i"})}};
  const auto u = drive(2, 300);
  const auto exact = Rows(drawn, {"x", "c"}, u).values();
  Rows unlimited(pid, {"x", "c"}, u);
  EXPECT_LT(relative_distance(unlimited.values(), exact), 1e-11);
  unlimited.set("c.upper", 0.5);
  EXPECT_GT(relative_distance(unlimited.values(16), exact), 1e-2);
}

/// A loop of some blocks in a row, at least one of them bent, pulled back by the last; beside it constants and what
/// skips a block.
Blocks any_loop(std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0, 1);
  const auto between = [&](double low, double high) { return low + (high - low) * share(random); };
  Blocks blocks{{"offset", block("constant", {{"value", number(between(-0.3, 0.3), "V")}})},
                {"e", block("sum", {{"signs", "+-+"}}, {"u", "back", "offset"})}};
  std::string last = "e", before = "offset";
  const int count = 3 + static_cast<int>(4 * share(random));
  for (int i = 0; i < count; ++i) {
    const std::string name = "b" + std::to_string(i);
    const int kind = i == 1 ? 3 : i == 2 ? 0 : static_cast<int>(7 * share(random));
    Node node = kind == 0   ? block("lag", {{"times", list({between(0.01, 0.05)}, "s")}}, {last})
                : kind == 1 ? block("gain", {{"gain", between(0.5, 1.2)}}, {last})
                : kind == 2
                    ? block("second_order", {{"frequency", number(between(5, 15), "Hz")}, {"damping", 0.7}}, {last})
                : kind == 3 ? block("soft_saturation", {{"limit", number(between(0.5, 1.5), "V")}}, {last})
                : kind == 4 ? block("play", {{"radius", number(between(0.05, 0.2), "V")}}, {last})
                : kind == 5 ? block("sum", {{"signs", "+-"}}, {last, before})
                            : block("polynomial",
                                    {{"coefficients", list({0, 1, between(-0.1, 0.1)}, "V")},
                                     {"reference", number(1, "V")},
                                     {"lower", number(-3, "V")},
                                     {"upper", number(3, "V")}},
                                    {last});
    blocks.emplace_back(name, std::move(node));
    before = std::exchange(last, name);
  }
  blocks.emplace_back("x", block("lag", {{"times", list({0.03}, "s")}}, {last}));
  blocks.emplace_back("back", block("gain", {{"gain", between(0.5, 1.5)}}, {"x"}));
  return blocks;
}

TEST(AdvanceLinearAt, LoopsAroundBentBlocksAgreeWithTheIntegrator) {
  std::mt19937_64 random(21);
  const auto u = drive(1, 200);
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    const Rows rows(any_loop(random), {"x", "b0", "b1", "e"}, u);
    ASSERT_EQ(why_not_exact(*rows.program), "");
    SimulateOptions options{.method = Method::bdf, .relative_tolerance = 1e-10, .at_rest = true};
    options.instants = u->t;
    // Where a play turns inside a step its memory is off by a second power of that step: 80 us of a motion of 35 rad/s
    // are (3e-3)^2/2 = 4e-6.
    EXPECT_LT(relative_distance(rows.values(64), simulate(*rows.program, rows.run, options).values), 1e-5);
  }
}

}  // namespace
}  // namespace hysteron
