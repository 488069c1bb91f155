// Algebraic loops against closed forms, and row by row.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/rowwise/advance.h"
#include "models/hysteresis/play.h"
#include "tests/engine/loop_diagrams.h"

namespace hysteron {
namespace {

using namespace tools;
using std::numbers::pi;

TEST(Loops, ALinearLoopHasTheClosedFormAtAnyGain) {
  // e = u - k e; fixed-point iteration would fail for |k| >= 1.
  for (const double k : {0.3, -0.9, 5.0, 1e6, -2.0}) {
    const auto program = compiled(feedback(block("gain", {{"gain", k}}, {"error"})));
    ASSERT_EQ(program->loops.size(), 1U);
    EXPECT_EQ(program->loops[0].tears.size(), 1U);
    // The back substitution of one division rounds a few times.
    EXPECT_NEAR(value_at(*program, 3, "error"), 3 / (1 + k), 1e-15 * 3 / std::abs(1 + k) * (1 + std::abs(k)));
  }
}

TEST(Loops, ASaturatingLoopHasTheClosedFormOnEveryPiece) {
  // y = sat(8 (u - y)) with limits -1 ... 2: y = 8/9 u while |..| holds, else the limit.
  const auto program =
      compiled(diagram({{"error", block("sum", {{"signs", "+-"}}, {"u", "y"})},
                        {"amplified", block("gain", {{"gain", 8.0}}, {"error"})},
                        {"y", block("saturation", {{"lower", "-1 V"}, {"upper", "2 V"}}, {"amplified"})}},
                       {"y"}, volts));
  for (double u = -5; u <= 5; u += 0.125)
    EXPECT_NEAR(value_at(*program, u, "y"), std::clamp(8.0 / 9 * u, -1.0, 2.0), 1e-14) << u;
}

TEST(Loops, AMonotoneLoopThatNewtonAloneDoesNotSolveIsBracketed) {
  // v = u - 1e4 v^3: from v = 0 Newton jumps to u and creeps back by thirds; r falls with v, so the bracket holds it.
  const auto program = compiled(diagram({{"v", block("sum", {{"signs", "+-"}}, {"u", "cube"})},
                                         {"square", block("product", {}, {"v", "v"})},
                                         {"third", block("product", {}, {"square", "v"})},
                                         {"cube", block("gain", {{"gain", "1e4 1/V^2"}}, {"third"})}},
                                        {"v"}, volts));
  for (const double u : {-1e6, -3.0, -1e-9, 0.0, 1e-3, 2.0, 1e9}) {
    const double v = value_at(*program, u, "v");
    // The last step squares the promised 1e-9; rounding of u and v remains, the latter three times in the cube.
    EXPECT_NEAR(v + 1e4 * v * v * v, u, 1e-14 * std::abs(u)) << u;
  }
}

TEST(Loops, WhatTheyTookIsCounted) {
  const auto program = compiled(diagram({{"v", block("sum", {{"signs", "+-"}}, {"u", "cube"})},
                                         {"square", block("product", {}, {"v", "v"})},
                                         {"third", block("product", {}, {"square", "v"})},
                                         {"cube", block("gain", {{"gain", "1e4 1/V^2"}}, {"third"})}},
                                        {"v"}, volts));
  const auto run = with_input(*program, 2);
  Work work(*program);
  for (int i = 0; i < 3; ++i) evaluate_values(*program, run, work, 0, run.x.data());
  const LoopCounters& c = work.loops->counters.at(0);
  EXPECT_EQ(c.solved, 3);
  EXPECT_EQ(c.failed, 0);
  EXPECT_EQ(c.bracketed, 3);  // Newton's first step from zero lands beyond the solution
  EXPECT_EQ(c.evaluations, 3 * c.most_evaluations);
  // From 2 V, thirds bring v within a few times the solution (0.058 V) in ten steps; then the error is squared.
  EXPECT_GT(c.most_evaluations, 8);
  EXPECT_LT(c.most_evaluations, 30);
  // The slope of the residual is 1 + 3e4 v^2 = 100: 100 times what rounding (and the tolerance, squared) leaves of v.
  EXPECT_GT(c.worst_residual, 0);
  EXPECT_LT(c.worst_residual, 1e-13);
}

TEST(Loops, StatisticsOfASimulationTellThem) {
  // y' = (e - y)/tau with e = u - 2 e, so e = u/3: linear, one evaluation finds the slope and the next is exact.
  const auto program = compiled(diagram({{"error", block("sum", {{"signs", "+-"}}, {"u", "back"})},
                                         {"back", block("gain", {{"gain", 2.0}}, {"error"})},
                                         {"y", block("lag", {{"times", list({0.1}, "s")}}, {"error"})}},
                                        {"y"}, volts));
  auto run = start(*program);
  bind_input(*program, run, "u", series({0, 1}, {0, 3}));
  for (const Method method : {Method::bdf, Method::rk4}) {
    const auto s = simulate(*program, run, {.until = 1, .method = method, .step = 0.01}).statistics;
    ASSERT_EQ(s.loops.size(), 1U);
    EXPECT_EQ(s.loops[0].path, "error -> back -> error");
    EXPECT_GE(s.loops[0].solved, s.evaluations);
    EXPECT_EQ(s.loops[0].failed, 0);
    EXPECT_LE(s.loops[0].most_evaluations, 3);
    EXPECT_LT(s.loops[0].worst_residual, 1e-14);
  }
}

TEST(Statistics, PhasesAreNotNegativeAndDoNotExceedTheWhole) {
  const auto program = compiled(diagram({{"y", block("lag", {{"times", list({0.1}, "s")}}, {"u"})},
                                         {"held", block("sample_hold", {{"period", "10 ms"}}, {"y"})},
                                         {"late", block("lag", {{"times", list({0.01}, "s")}}, {"held"})}},
                                        {"late"}, volts));
  auto run = start(*program);
  bind_input(*program, run, "u", series({0, 1}, {0, 3}));
  for (const Method method : {Method::bdf, Method::runge_kutta, Method::rk4, Method::exact}) {
    const auto s = simulate(*program, run, {.until = 1, .method = method, .step = 0.01}).statistics;
    EXPECT_GE(s.phases.integrate, 0);
    EXPECT_GE(s.phases.events, 0);
    EXPECT_GE(s.phases.output, 0);
    EXPECT_LE(s.phases.integrate + s.phases.events + s.phases.output, s.seconds);
    EXPECT_GT(s.phases.integrate, 0);
  }
}

/// The operators of the thesis behind their own inverse: u_c = (r - sum w_i P_i(u_c)) / w_0 with
/// w_0 = ratio * sum of the others.
Diagram inverse_compensator(double ratio) {
  const double rest = std::accumulate(thesis_weights.begin() + 1, thesis_weights.end(), 0.0);
  return diagram({{"lack", block("sum", {{"signs", "+-"}}, {"u", "curved"})},
                  {"command", block("gain", {{"gain", 1 / (ratio * rest)}}, {"lack"})},
                  {"curved", block("prandtl_ishlinskii",
                                   {{"thresholds", list({thesis_thresholds.begin() + 1, thesis_thresholds.end()}, "V")},
                                    {"weights", list({thesis_weights.begin() + 1, thesis_weights.end()})}},
                                   {"command"})}},
                 {"command"}, volts);
}

TEST(Loops, TenPlayOperatorsInAnInverseAreSolvedAtEveryGainRatio) {
  const double rest = std::accumulate(thesis_weights.begin() + 1, thesis_weights.end(), 0.0);
  for (const double ratio : {1.2, 0.9, 0.5, 0.2, 0.05}) {
    const auto program = compiled(inverse_compensator(ratio));
    auto run = with_input(*program, 0);
    Work work(*program);
    std::vector<double> memory(thesis_weights.size(), 0.0);  // the operators once more, walked by hand
    const int samples = 400;
    for (int i = 0; i <= samples; ++i) {
      const double r = 4 * (1 - std::cos(4 * pi * i / samples)) * (i < samples / 2 ? 1 : 0.6);
      bind_input(*program, run, "u", series({0}, {r}));
      accept(*program, run, work, 0, run.x.data());
      const double command = work.y[at(program->signal("command"))];
      double back = ratio * rest * command;
      for (std::size_t k = 1; k < memory.size(); ++k) {
        memory[k] = play::follow_one_sided(thesis_thresholds[k], memory[k], command);
        back += thesis_weights[k] * memory[k];
      }
      // Promised: 1e-9 of the command, plus roundings; the last Newton step makes it better where pieces are straight.
      EXPECT_NEAR(back, r, 1e-9 * 8) << ratio << " at sample " << i;
    }
    EXPECT_LT(work.loops->evaluations, 5 * samples) << "Newton needs two or three evaluations a sample";
  }
}

TEST(Loops, TwoCoupledLoopsAreSolvedTogether) {
  // a = u - 2 a - 3 b, b = a - 0.5 b: two numbers that no single cut makes known. b = a / 1.5, a = u / (3 + 2).
  const auto program = compiled(diagram({{"a", block("sum", {{"signs", "+--"}}, {"u", "a2", "b3"})},
                                         {"a2", block("gain", {{"gain", 2.0}}, {"a"})},
                                         {"b", block("sum", {{"signs", "+-"}}, {"a", "b_half"})},
                                         {"b_half", block("gain", {{"gain", 0.5}}, {"b"})},
                                         {"b3", block("gain", {{"gain", 3.0}}, {"b"})}},
                                        {"a", "b"}, volts));
  ASSERT_EQ(program->loops.size(), 1U);
  EXPECT_EQ(program->loops[0].tears.size(), 2U);
  EXPECT_NEAR(value_at(*program, 10, "a"), 2, 1e-14);
  EXPECT_NEAR(value_at(*program, 10, "b"), 2 / 1.5, 1e-14);
}

TEST(Loops, MoreTearsThanSlopesAtOnceAreSolvedInChunks) {
  // x_i = u + mean of all others / 2, 11 of them: all equal, x = 2 u. Every pair feeds each other.
  const int n = 11;
  std::vector<std::pair<std::string, Node>> blocks;
  for (int i = 0; i < n; ++i) {
    std::vector<std::string> others{"u"};
    for (int j = 0; j < n; ++j)
      if (j != i) others.push_back("k" + std::to_string(j));
    blocks.emplace_back("x" + std::to_string(i), block("sum", {{"signs", std::string(others.size(), '+')}}, others));
    blocks.emplace_back("k" + std::to_string(i), block("gain", {{"gain", 0.05}}, {"x" + std::to_string(i)}));
  }
  const auto program = compiled(diagram(blocks, {"x3"}, volts));
  ASSERT_EQ(program->loops.size(), 1U);
  EXPECT_EQ(program->loops[0].tears.size(), at(n - 1));
  EXPECT_NEAR(value_at(*program, 3, "x3"), 6, 1e-12);
}

TEST(Loops, APlantWithFeedthroughInFeedbackIsTheClosedLoopTransferFunction) {
  // (s + 2)/(s + 1) with gain k around it: k(s+2)/((1+k)s + 1 + 2k).
  const double k = 3;
  const auto program = compiled(diagram(
      {{"r", block("sine", {{"amplitude", "1 V"}, {"frequency", "2 Hz"}})},
       {"error", block("sum", {{"signs", "+-"}}, {"r", "y"})},
       {"y", block("transfer_function", {{"gain", k}, {"num", list({1, 2})}, {"den", list({1, 1})}}, {"error"})},
       {"closed",
        block("transfer_function", {{"gain", k}, {"num", list({1, 2})}, {"den", list({1 + k, 1 + 2 * k})}}, {"r"})}},
      {"y", "closed"}));
  SimulateOptions options{.until = 2, .method = Method::bdf, .relative_tolerance = 1e-8};
  const auto traces = simulate(*program, start(*program), options);
  EXPECT_LT(distance(trace(traces, 0), trace(traces, 1)), 20 * 1e-8);  // both integrated to 1e-8
}

TEST(Loops, LinearLoopsAdvanceExactlyWithAndWithoutStates) {
  // e = u - 3 e behind a lag of 0.1 s around which 2 (1 + feedthrough) closes: compared with the integration.
  const auto program =
      compiled(diagram({{"e", block("sum", {{"signs", "+--"}}, {"u", "three", "y"})},
                        {"three", block("gain", {{"gain", 3.0}}, {"e"})},
                        {"y", block("transfer_function", {{"num", list({1, 4})}, {"den", list({0.1, 1})}}, {"e"})}},
                       {"e", "y"}, volts));
  ASSERT_EQ(why_not_exact(*program), "");
  auto run = start(*program);
  bind_input(*program, run, "u", series(grid(0, 1, 50), [] {
    auto v = grid(0, 1, 50);
    for (auto& x : v) x = std::sin(9 * x);
    return v;
  }()));
  const auto exact = simulate(*program, run, {.until = 1, .method = Method::exact});
  const auto bdf = simulate(*program, run, {.until = 1, .method = Method::bdf, .relative_tolerance = 1e-9});
  for (std::size_t s = 0; s < 2; ++s) EXPECT_LT(distance(trace(exact, s), trace(bdf, s)), 100 * 1e-9);
  const auto without = compiled(feedback(block("gain", {{"gain", 4.0}}, {"error"})));
  auto still = start(*without);
  bind_input(*without, still, "u", series({0, 1}, {0, 10}));
  const auto traces = simulate(*without, still, {.until = 1, .method = Method::exact});
  EXPECT_EQ(traces.statistics.method, "exact");
  for (std::size_t i = 0; i < traces.t.size(); ++i) EXPECT_NEAR(trace(traces)[i], 2 * traces.t[i], 1e-13);
}

TEST(Loops, LoopsThroughNonlinearBlocksAreNotAdvancedExactlyAndSayWhy) {
  EXPECT_NE(why_not_exact(*compiled(kinked())).find("feedback loop"), std::string::npos);
  const auto itself = compiled(diagram({{"v", block("product", {}, {"u", "v"})}}, {"v"}, {{"u", "1"}}));
  EXPECT_NE(why_not_exact(*itself).find("\"v\""), std::string::npos);
}

}  // namespace
}  // namespace hysteron
