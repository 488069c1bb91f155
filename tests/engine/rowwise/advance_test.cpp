#include "engine/rowwise/advance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "blocks/register_all.h"
#include "tests/engine/diagrams_in_code.h"

namespace hysteron {
namespace {

using test::node;
using test::numbers;
using test::series;
using test::volts;

const Registry& registry() {
  static const Registry all = all_blocks();
  return all;
}

std::vector<double> times(double h, int n) {
  std::vector<double> t;
  for (int i = 0; i < n; ++i) t.push_back(h * i);
  return t;
}

/// Output "y" of a diagram with input "u" at the instants.
std::vector<double> response(const Diagram& d, const SeriesPointer& u, const std::vector<double>& instants,
                             AdvanceOptions options = {}) {
  const auto program = compile(d, registry());
  hysteron::Run run = start(*program);
  bind_input(*program, run, "u", u);
  std::vector<std::vector<double>> values;
  Advance(program, program->output_signals)(run, instants, options, values);
  return values[0];
}

Diagram with_output(std::initializer_list<std::pair<const char*, Node>> blocks, const std::string& output) {
  Diagram d;
  d.inputs["u"] = {"V", ""};
  for (const auto& [name, n] : blocks) d.blocks[name] = n;
  d.outputs["y"] = output;
  return d;
}

TEST(Advance, ALagDrivenByARampFollowsTheClosedForm) {
  const double tau = 0.3;
  const auto d = with_output({{"lag", node("lag", {"u"}, {{"times", numbers({tau})}})}}, "lag");
  const auto t = times(0.1, 40);
  const auto y = response(d, series({0, 10}, {0, 20}), t);
  // Ramp 2 V/s into a lag at rest: y = 2 (t - tau (1 - exp(-t/tau))). Tolerance: rounding of 40 steps.
  for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(y[i], 2 * (t[i] - tau * (1 - std::exp(-t[i] / tau))), 1e-13);
}

TEST(Advance, ResultsDoNotDependOnWhichInstantsAreAsked) {
  const auto d =
      with_output({{"plant", node("transfer_function", {"u"}, {{"num", numbers({4})}, {"den", numbers({1, 0.4, 4})}})},
                   {"lag", node("lag", {"plant"}, {{"times", numbers({0.2})}})}},
                  "lag");
  std::vector<double> t_u, v_u;
  for (int i = 0; i < 50; ++i) {
    t_u.push_back(0.1 * i + 0.03 * std::sin(i));
    v_u.push_back(std::cos(1.7 * i));
  }
  const auto u = series(t_u, v_u);
  const auto fine = times(0.01, 400);
  const auto coarse = times(0.05, 80);
  const auto a = response(d, u, fine);
  const auto b = response(d, u, coarse);
  for (std::size_t i = 0; i < coarse.size(); ++i) EXPECT_NEAR(a[5 * i], b[i], 1e-12);
}

TEST(Advance, AHeldInputIsAStaircaseNotAPolygon) {
  const auto d = with_output({{"integral", node("integrator", {"u"})}}, "integral");
  const auto t = times(1, 5);
  const std::vector<double> v{1, 3, -2, 5, 0};
  const auto held = response(d, series(t, v, Between::hold), t);
  const auto linear = response(d, series(t, v), t);
  EXPECT_NEAR(held[4], 1 + 3 - 2 + 5, 1e-13);
  EXPECT_NEAR(linear[4], 0.5 * 1 + 3 - 2 + 5, 1e-13);
  EXPECT_NEAR(held[1], 1, 1e-13) << "a row shows the signal after the jump, the integral up to it";
}

TEST(Advance, APlayBehindAHeldInputSeesTheJumpAtItsRow) {
  const auto d = with_output({{"play", node("play", {"u"}, {{"radius", "1 V"}})}}, "play");
  const auto t = times(1, 4);
  const auto y = response(d, series(t, {0, 3, 2.5, -3}, Between::hold), t);
  EXPECT_EQ(y, (std::vector<double>{0, 2, 2, -2}));
}

TEST(Advance, RestIsTheEquilibriumOfTheFirstInput) {
  const auto d = with_output({{"plant", node("transfer_function", {"u"},
                                             {{"gain", 3.0}, {"num", numbers({2})}, {"den", numbers({1, 0.4, 4})}})}},
                             "plant");
  const auto y = response(d, series({0, 1}, {5, 5}), times(0.1, 10));
  for (const double v : y) EXPECT_NEAR(v, 3.0 * 2 / 4 * 5, 1e-12);
  const auto given = response(d, series({0, 1}, {5, 5}), times(0.1, 10), {.substeps = 1, .at_rest = false});
  EXPECT_NEAR(given[0], 0, 1e-15);
}

TEST(Advance, AFeedbackLoopOfLinearBlocksIsOneExactSystem) {
  // PI controller around a lag: closed loop (kp s + ki)/(tau s^2 + (1 + kp) s + ki).
  const auto loop = with_output({{"error", node("sum", {"u", "plant"}, {{"signs", "+-"}})},
                                 {"controller", node("pi_controller", {"error"}, {{"kp", 2.0}, {"ki", "30 1/s"}})},
                                 {"plant", node("lag", {"controller"}, {{"times", numbers({0.1})}})}},
                                "plant");
  const auto closed = with_output(
      {{"t", node("transfer_function", {"u"}, {{"num", numbers({2, 30})}, {"den", numbers({0.1, 3, 30})}})}}, "t");
  std::vector<double> v;
  const auto t = times(0.02, 200);
  for (const double s : t) v.push_back(std::sin(9 * s));
  const auto a = response(loop, series(t, v), t);
  const auto b = response(closed, series(t, v), t);
  for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-11);
}

TEST(Advance, BehindMemorySubstepsConvergeAtSecondOrder) {
  const auto d = with_output({{"core", node("prandtl_ishlinskii", {"u"},
                                            {{"thresholds", volts({0, 0.5, 1})}, {"weights", numbers({1, 0.5, 0.4})}})},
                              {"plant", node("lag", {"core"}, {{"times", numbers({0.5})}})}},
                             "plant");
  const auto t = times(0.5, 60);
  std::vector<double> v;
  for (const double s : t) v.push_back(2 - 2 * std::cos(0.9 * s));
  const auto program = compile(d, registry());
  EXPECT_FALSE(Advance(program, program->output_signals).exact_without_substeps());
  const auto exact = response(d, series(t, v), t, {.substeps = 4096});
  const auto error = [&](int substeps) {
    const auto y = response(d, series(t, v), t, {.substeps = substeps});
    double worst = 0;
    for (std::size_t i = 0; i < t.size(); ++i) worst = std::max(worst, std::abs(y[i] - exact[i]));
    return worst;
  };
  // A kink inside a substep of length h shifts the held mean by O(h^2): 16 times the substeps, at least 60 times the
  // accuracy.
  EXPECT_LT(error(64), error(4) / 60);
}

TEST(Advance, MemoryAloneIsExactWithOneStepARow) {
  const auto d = with_output(
      {{"core",
        node("prandtl_ishlinskii", {"u"}, {{"thresholds", volts({0, 0.5, 1})}, {"weights", numbers({1, 0.5, 0.4})}})}},
      "core");
  const auto program = compile(d, registry());
  EXPECT_TRUE(Advance(program, program->output_signals).exact_without_substeps());
  const auto t = times(1, 6);
  const std::vector<double> v{0, 3, 1, 2.2, 0.3, 4};
  const auto one = response(d, series(t, v), t);
  const auto many = response(d, series(t, v), t, {.substeps = 7});
  for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(one[i], many[i], 1e-14);
}

TEST(Advance, ADeadTimeOfARecordedSignalIsItsPast) {
  const auto d = with_output({{"delay", node("dead_time", {"u"}, {{"delay", "0.35 s"}})}}, "delay");
  const auto t = times(0.2, 30);
  std::vector<double> v;
  for (std::size_t i = 0; i < t.size(); ++i) v.push_back(std::sin(1.0 + 3.0 * static_cast<double>(i)));
  const auto u = series(t, v);
  const auto y = response(d, u, t);
  for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(y[i], u->value(t[i] - 0.35, t[i] - 0.35), 1e-13) << i;
}

TEST(Advance, WhatCannotBeAdvancedExactlySaysWhichBlockStandsInTheWay) {
  // The play is bent and needs the sum at once, which needs the play.
  Diagram d = with_output({{"sum", node("sum", {"u", "half"})},
                           {"play", node("play", {"sum"}, {{"radius", "1 V"}})},
                           {"half", node("gain", {"play"}, {{"gain", 0.5}})}},
                          "half");
  EXPECT_NE(why_not_exact(*compile(d, registry())).find("algebraic loop"), std::string::npos);
  d = with_output(
      {{"sine", node("sine", {}, {{"amplitude", "1 V"}, {"frequency", "1 Hz"}})}, {"sum", node("sum", {"u", "sine"})}},
      "sum");
  EXPECT_NE(why_not_exact(*compile(d, registry())).find("\"sine\""), std::string::npos);
}

}  // namespace
}  // namespace hysteron
