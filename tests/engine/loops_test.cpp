// Algebraic loops against closed forms, and the promises of engine/loops.h: pure, exact slopes, no allocation, the same
// in any order of blocks, and a failure that can be acted on.
#include "engine/loops.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/advance.h"
#include "models/play.h"
#include "tests/engine/allocations.h"
#include "tests/engine/event_blocks.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;
using std::numbers::pi;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// A run with one input "u" that stands at `value`.
Run with_input(const Program& program, double value) {
  auto run = start(program);
  bind_input(program, run, "u", series({0}, {value}));
  set_loop_accuracy(program, run, 1e-6, 1e-2);
  return run;
}

/// The value of a signal at t = 0 with the input at `u`.
double value_at(const Program& program, double u, const std::string& signal) {
  const auto run = with_input(program, u);
  Work work(program);
  evaluate_values(program, run, work, 0, run.x.data());
  throw_if_unsolved(program, work, 0);
  return work.y[at(program.signal(signal))];
}

const std::vector<std::pair<std::string, std::string>> volts{{"u", "V"}};

/// error = u - gain * back, back = block(error).
Diagram feedback(const Node& block_in_the_loop, std::vector<std::string> record = {"error", "back"}) {
  return diagram({{"error", block("sum", {{"signs", "+-"}}, {"u", "back"})}, {"back", block_in_the_loop}},
                 std::move(record), volts);
}

// --- closed forms
// -----------------------------------------------------------------------------------------------------

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
/// w_0 = ratio * sum of the others (ENGINE 17).
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

// --- rates
// ------------------------------------------------------------------------------------------------------------

struct BoucWenNumbers {
  double alpha = 0.6187, beta = 0.2418, gamma = 0.0237, d_p = 1.6126;  // SPEC 2.3, in V
};

/// z of a Bouc-Wen law driven by u with u' = r' / (divisor - gain * A), A = dz/du of the active branch: the loop of
/// rates solved by hand. Classical Runge-Kutta.
std::vector<double> by_hand(const BoucWenNumbers& p, double divisor, double gain, const std::vector<double>& t,
                            double (*rate)(double)) {
  const auto slope = [&](double time, double z) {
    const double r = rate(time);
    // The divisor is positive, so u' has the sign of r'.
    const double a = p.alpha - p.beta * (r >= 0 ? z : -z) - p.gamma * std::abs(z);
    return a * r / (divisor - gain * a);
  };
  std::vector<double> z{0};
  const int substeps = 40;
  for (std::size_t i = 1; i < t.size(); ++i) {
    double now = z.back();
    const double h = (t[i] - t[i - 1]) / substeps;
    for (int k = 0; k < substeps; ++k) {
      const double s = t[i - 1] + k * h;
      const double k1 = slope(s, now), k2 = slope(s + h / 2, now + h / 2 * k1), k3 = slope(s + h / 2, now + h / 2 * k2),
                   k4 = slope(s + h, now + h * k3);
      now += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    z.push_back(now);
  }
  return z;
}

double cosine_rate(double t) { return 3 * 2 * pi * 5 * std::sin(2 * pi * 5 * t); }  // of 3 (1 - cos(2 pi 5 t))

Node bouc_wen(const BoucWenNumbers& p, double d_p, const std::string& in) {
  return block("bouc_wen",
               {{"alpha", p.alpha}, {"beta", Number{p.beta, "1/V"}}, {"gamma", Number{p.gamma, "1/V"}}, {"d_p", d_p}},
               {in});
}

TEST(Loops, ALawInItsOwnFeedbackSolvesTheLoopOfRates) {
  // u = r - k y, y = d_p u - z: u' (1 + k d_p - k A) = r'.
  const BoucWenNumbers p;
  const double k = 0.7;
  const auto program = compiled(diagram({{"r", thesis_wave("sine", "3 V")},
                                         {"u", block("sum", {{"signs", "+-"}}, {"r", "scaled"})},
                                         {"y", bouc_wen(p, p.d_p, "u")},
                                         {"scaled", block("gain", {{"gain", k}}, {"y"})}},
                                        {"u", "y", "r"}));
  EXPECT_TRUE(program->has_rate_loops());
  SimulateOptions options{.until = 0.5, .method = Method::bdf, .relative_tolerance = 1e-8};
  const auto traces = simulate(*program, start(*program), options);
  const auto z = by_hand(p, 1 + k * p.d_p, k, traces.t, cosine_rate);
  std::vector<double> found;
  for (std::size_t i = 0; i < z.size(); ++i) found.push_back(p.d_p * trace(traces, 0)[i] - trace(traces, 1)[i]);
  // Five periods of local errors of 1e-8; z is about one.
  EXPECT_LT(distance(found, z), 1e-6);
}

TEST(Loops, TheBoucWenCompensatorOfFigure2_8InvertsTheActuator) {
  // u = (r + z(u)) / d_p with the law's z in the loop of rates: u' (d_p - A) = r'. Behind it the actuator gives r
  // again.
  const BoucWenNumbers p;
  const auto program = compiled(diagram({{"r", thesis_wave("sine", "3 V")},
                                         {"lack", block("sum", {{"signs", "+-"}}, {"r", "minus_z"})},
                                         {"u", block("gain", {{"gain", 1 / p.d_p}}, {"lack"})},
                                         {"minus_z", bouc_wen(p, 0, "u")},
                                         {"actuator", bouc_wen(p, p.d_p, "u")}},
                                        {"r", "actuator", "minus_z"}));
  SimulateOptions options{.until = 0.5, .method = Method::bdf, .relative_tolerance = 1e-8};
  const auto traces = simulate(*program, start(*program), options);
  EXPECT_LT(distance(trace(traces, 1), trace(traces, 0)), 1e-6);
  auto z = by_hand(p, p.d_p, 1, traces.t, cosine_rate);
  for (auto& v : z) v = -v;
  EXPECT_LT(distance(trace(traces, 2), z), 1e-6);
}

TEST(Loops, AJumpIntoALoopOfRatesIsTheFastRamp) {
  // The same loop behind a step of 3 V: rate independent, so z is that of any monotone way from 0 to 3 V.
  const BoucWenNumbers p;
  const double k = 0.7;
  const auto program = compiled(diagram({{"r", block("step", {{"after", "3 V"}, {"time", "0.1 s"}})},
                                         {"u", block("sum", {{"signs", "+-"}}, {"r", "scaled"})},
                                         {"y", bouc_wen(p, p.d_p, "u")},
                                         {"scaled", block("gain", {{"gain", k}}, {"y"})}},
                                        {"u", "y"}));
  SimulateOptions options{.until = 0.2, .method = Method::bdf, .relative_tolerance = 1e-8};
  const auto traces = simulate(*program, start(*program), options);
  const double z = by_hand(p, 1 + k * p.d_p, k, grid(0, 0.05, 100), cosine_rate).back();  // a quarter period: 3 V
  EXPECT_NEAR(p.d_p * trace(traces, 0).back() - trace(traces, 1).back(), z, 1e-7);
}

TEST(Loops, ALoopInASampledDiagramIsSolvedAtEveryInstant) {
  // e = 1 V - 2 e - s between and at the instants, s_{k+1} = s_k + 0.3 e_k: e_k = (1 - s_k) / 3.
  const auto program = compile(diagram({{"r", block("constant", {{"value", "1 V"}})},
                                        {"e", block("sum", {{"signs", "+--"}}, {"r", "twice", "s"})},
                                        {"twice", block("gain", {{"gain", 2.0}}, {"e"})},
                                        {"s", block("test_accumulator", {{"gain", 0.3}, {"period", "0.1 s"}}, {"e"})},
                                        {"seen", block("test_sampler", {{"period", "0.1 s"}}, {"e"})}},
                                       {"e", "s", "seen"}),
                               test::registry_with_events());
  ASSERT_EQ(program->loops.size(), 1U);
  const auto traces = simulate(*program, start(*program), {.until = 1.95, .every = 0.05, .method = Method::bdf});
  const double step = 0.3 / 3;
  for (std::size_t i = 0; i < traces.t.size(); ++i) {
    // 1 - s shrinks by 1 - 0.1 a period. At an instant the accumulator still shows what it held.
    const double lack = std::pow(1 - step, static_cast<double>(i / 2));
    EXPECT_NEAR(trace(traces, 1)[i], 1 - lack, 1e-13) << i;
    EXPECT_NEAR(trace(traces, 0)[i], lack / 3, 1e-13) << i;
    EXPECT_NEAR(trace(traces, 2)[i], lack / 3, 1e-13) << i;
  }
}

// --- promises
// ---------------------------------------------------------------------------------------------------------

/// A loop with kinks and memory around a state: x' = (sat(u - play(5 x + loop)) - x) / tau.
Diagram kinked(bool reversed = false) {
  std::vector<std::pair<std::string, Node>> blocks{
      {"error", block("sum", {{"signs", "+--"}}, {"u", "bent", "x"})},
      {"amplified", block("gain", {{"gain", 4.0}}, {"error"})},
      {"limited", block("saturation", {{"lower", "-2 V"}, {"upper", "2 V"}}, {"amplified"})},
      {"bent", block("play", {{"radius", "0.05 V"}}, {"limited"})},
      {"second", block("sum", {{"signs", "+-"}}, {"bent", "half"})},
      {"half", block("gain", {{"gain", 0.5}}, {"second"})},
      {"x", block("lag", {{"times", list({0.02}, "s")}}, {"second"})}};
  if (reversed) std::reverse(blocks.begin(), blocks.end());
  return diagram(blocks, {"x", "limited", "half"}, volts);
}

TEST(Loops, AnEvaluationGivesTheSameBitsHoweverOftenAndAfterWhatever) {
  const auto program = compiled(kinked());
  auto run = with_input(*program, 0.7);
  Work work(*program);
  accept(*program, run, work, 0, run.x.data());
  const double x = 0.21, other = -3;
  evaluate_derivatives(*program, run, work, 0, &x);
  const double first = work.dx[0];
  const auto before = run;
  evaluate_derivatives(*program, run, work, 0, &other);
  EXPECT_NE(work.dx[0], first);
  evaluate_derivatives(*program, run, work, 0, &x);
  EXPECT_EQ(work.dx[0], first) << "a trial left a trace";
  EXPECT_EQ(run.warm, before.warm);
  Work fresh(*program);
  evaluate_derivatives(*program, run, fresh, 0, &x);
  EXPECT_EQ(fresh.dx[0], first);
}

TEST(Loops, TheResultDoesNotDependOnTheOrderOfBlocksInTheFile) {
  const auto drive = series({0, 0.1, 0.25, 0.3}, {0, 2, -1, 0.4});
  std::vector<Traces> both;
  for (const bool reversed : {false, true}) {
    const auto program = compiled(kinked(reversed));
    auto run = start(*program);
    bind_input(*program, run, "u", drive);
    both.push_back(simulate(*program, run, {.until = 0.3, .method = Method::bdf}));
  }
  for (std::size_t s = 0; s < 3; ++s) EXPECT_EQ(trace(both[0], s), trace(both[1], s));
}

TEST(Loops, SlopesThroughALoopAreThoseOfDifferences) {
  const auto program = compiled(kinked());
  auto run = with_input(*program, 0.3);
  Work work(*program);
  accept(*program, run, work, 0, run.x.data());
  const int gain = program->find_parameter("amplified.gain")->slots[0];
  const int half = program->find_parameter("half.gain")->slots[0];
  const auto derivative = [&](double x, double change_gain, double change_half) {
    auto moved = run;
    moved.p[at(gain)] += change_gain;
    moved.p[at(half)] += change_half;
    evaluate_derivatives(*program, moved, work, 0, &x);
    return work.dx[0];
  };
  for (const double x0 : {0.01, 0.4, -0.9, 3.0}) {  // on the play's flank, inside it, on both limits
    JetWork jets(*program);
    jets.refresh(run);
    Jet x(x0);
    x.slope[0] = 1;
    jets.p[at(gain)].slope[3] = 1;
    jets.p[at(half)].slope[7] = 1;
    evaluate_derivatives(*program, run, jets, 0, &x);
    const double h = 1e-6;
    EXPECT_EQ(jets.dx[0].value, derivative(x0, 0, 0));
    // Central differences of straight pieces: rounding over h, about 1e-10 of a rate of 100 V/s.
    EXPECT_NEAR(jets.dx[0].slope[0], (derivative(x0 + h, 0, 0) - derivative(x0 - h, 0, 0)) / (2 * h), 1e-6) << x0;
    EXPECT_NEAR(jets.dx[0].slope[3], (derivative(x0, h, 0) - derivative(x0, -h, 0)) / (2 * h), 1e-6) << x0;
    EXPECT_NEAR(jets.dx[0].slope[7], (derivative(x0, 0, h) - derivative(x0, 0, -h)) / (2 * h), 1e-6) << x0;
    EXPECT_EQ(jets.dx[0].slope[1], 0);
  }
}

TEST(Loops, SlopesThroughALoopOfRatesAreThoseOfDifferences) {
  const BoucWenNumbers p;
  const auto program = compiled(diagram({{"slow", block("lag", {{"times", list({0.1}, "s")}}, {"u"})},
                                         {"v", block("sum", {{"signs", "+-"}}, {"slow", "y"})},
                                         {"y", bouc_wen(p, p.d_p, "v")}},
                                        {"y"}, volts));
  const auto run = with_input(*program, 2);
  Work work(*program);
  const auto z_index = at(static_cast<int>(std::find(program->state_names.begin(), program->state_names.end(), "y.z") -
                                           program->state_names.begin()));
  ASSERT_LT(z_index, 2U);
  const std::vector<double> x0{0.3, 0.3};
  JetWork jets(*program);
  jets.refresh(run);
  std::vector<Jet> x{Jet(x0[0]), Jet(x0[1])};
  x[0].slope[0] = x[1].slope[1] = 1;
  evaluate_derivatives(*program, run, jets, 0, x.data());
  for (std::size_t k = 0; k < 2; ++k) {
    const double h = 1e-6;
    auto up = x0, down = x0;
    up[k] += h;
    down[k] -= h;
    evaluate_derivatives(*program, run, work, 0, up.data());
    const double above = work.dx[z_index];
    evaluate_derivatives(*program, run, work, 0, down.data());
    // Differences of a smooth function of size 10: h^2 and rounding over h.
    EXPECT_NEAR(jets.dx[z_index].slope[k], (above - work.dx[z_index]) / (2 * h), 1e-7) << k;
  }
}

TEST(Loops, AnEvaluationTakesNothingFromTheHeap) {
  const auto program = compiled(kinked());
  auto run = with_input(*program, 0.7);
  Work work(*program);
  JetWork jets(*program);
  jets.refresh(run);
  const double x = 0.1;
  const Jet jet(0.1);
  evaluate_derivatives(*program, run, work, 0, &x);
  const long before = allocations();
  for (int i = 0; i < 10; ++i) {
    evaluate_derivatives(*program, run, work, 0, &x);
    evaluate_memory_rates(*program, run, work, 0, &x);
    evaluate_values(*program, run, work, 0, &x);
    evaluate_derivatives(*program, run, jets, 0, &jet);
    accept(*program, run, work, 0, &x);
  }
  EXPECT_EQ(allocations(), before);
}

TEST(Loops, TheErrorFollowsTheToleranceThatIsAskedFor) {
  // v = u - v^3, smooth: v = 1 at u = 2. The start is 0, so nothing is exact by luck.
  const auto program = compiled(diagram({{"v", block("sum", {{"signs", "+-"}}, {"u", "cube"})},
                                         {"square", block("product", {}, {"v", "v"})},
                                         {"third", block("product", {}, {"square", "v"})},
                                         {"cube", block("gain", {{"gain", "1 1/V^2"}}, {"third"})}},
                                        {"v"}, volts));
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-10}) {
    auto run = with_input(*program, 2);
    set_loop_accuracy(*program, run, tolerance, 1e-2);
    Work work(*program);
    evaluate_values(*program, run, work, 0, run.x.data());
    EXPECT_NEAR(work.y[at(program->signal("v"))], 1, std::max(1e-3 * tolerance, 1e-15)) << tolerance;
  }
}

// --- several solutions, and none
// --------------------------------------------------------------------------------------

/// v = u + v^2 / 4 V: solutions 2 -+ 2 sqrt(1 - u), which meet at u = 1 V.
Diagram folded(const std::string& source = "u") {
  return diagram({{"v", block("sum", {}, {source, "quarter"})},
                  {"square", block("product", {}, {"v", "v"})},
                  {"quarter", block("gain", {{"gain", "0.25 1/V"}}, {"square"})}},
                 {"v"}, volts);
}

TEST(Loops, OfSeveralSolutionsTheOneNearTheGuessIsFound) {
  auto d = folded();
  EXPECT_NEAR(value_at(*compiled(d), 0.5, "v"), 2 - std::sqrt(2), 1e-12);
  d.simulate.guess["v"] = Number{3.5, "V"};
  EXPECT_NEAR(value_at(*compiled(d), 0.5, "v"), 2 + std::sqrt(2), 1e-12);
  d.simulate.guess["v"] = Number{3500, "mV"};
  EXPECT_NEAR(value_at(*compiled(d), 0.5, "v"), 2 + std::sqrt(2), 1e-12);
}

TEST(Loops, ABranchIsFollowedFromAcceptedPointToAcceptedPoint) {
  auto d = folded();
  d.simulate.guess["v"] = Number{3.5, "V"};
  const auto program = compiled(d);
  auto run = start(*program);
  bind_input(*program, run, "u", series({0, 1}, {-8, 0.9}));
  const auto traces = simulate(*program, run, {.until = 1, .method = Method::bdf});
  for (std::size_t i = 0; i < traces.t.size(); ++i)
    EXPECT_NEAR(trace(traces)[i], 2 + 2 * std::sqrt(1 - (-8 + 8.9 * traces.t[i])), 1e-7);
}

Problem failure(const Program& program, const Run& run, const SimulateOptions& options) {
  try {
    simulate(program, run, options);
  } catch (const Error& e) {
    EXPECT_EQ(e.fault, Fault::numerics);
    return e.problems.front();
  }
  ADD_FAILURE() << "nothing failed";
  return {};
}

TEST(Loops, AFoldIsNamedWithTheWayAroundTheResidualAndThreeCures) {
  const auto program = compiled(folded());
  auto run = start(*program);
  bind_input(*program, run, "u", series({0, 1}, {0, 2}));
  const auto p = failure(*program, run, {.until = 1, .method = Method::bdf});
  EXPECT_EQ(p.code, "loop_unsolved");
  EXPECT_NE(p.what.find("v -> square -> quarter -> v"), std::string::npos) << p.what;
  EXPECT_NE(p.what.find("residual"), std::string::npos) << p.what;
  EXPECT_NE(p.what.find("fold"), std::string::npos) << p.what;
  EXPECT_NE(p.what.find(" V"), std::string::npos) << p.what;
  for (const char* cure : {"guess", "lag", "inverse"}) EXPECT_NE(p.cure.find(cure), std::string::npos) << p.cure;
}

TEST(Loops, TheIntegratorTriesSmallerStepsBeforeALoopIsGivenUp) {
  // x' = v(x), v = x + v^2/4: x grows until x = 1, where the loop folds; the failure is told within a step of that.
  auto d = folded("x");
  d.blocks["x"] = block("integrator", {{"initial", "0.1 V"}}, {"rate"});
  d.blocks["rate"] = block("gain", {{"gain", "1 1/s"}}, {"v"});
  d.inputs.erase("u");
  d.record = {"x"};
  const auto program = compiled(d);
  const auto p = failure(*program, start(*program), {.until = 10, .method = Method::bdf});
  EXPECT_EQ(p.code, "loop_unsolved") << p.what;
  const auto found = p.what.find("t = ");
  ASSERT_NE(found, std::string::npos);
  // dt = dx / (2 - 2 sqrt(1 - x)); with q = sqrt(1 - x): t = [q - ... ] = integral of q / (1 - q) dq = -q - ln(1 - q).
  const double q = std::sqrt(0.9);
  EXPECT_NEAR(std::stod(p.what.substr(found + 4)), -q - std::log(1 - q), 1e-2);
}

TEST(Loops, ALoopWithGainOneHasNoSolutionAndSaysSo) {
  const auto program = compiled(
      diagram({{"v", block("sum", {}, {"u", "same"})}, {"same", block("gain", {{"gain", 1.0}}, {"v"})}}, {"v"}, volts));
  auto run = start(*program);
  bind_input(*program, run, "u", series({0, 1}, {1, 2}));
  for (const auto method : {Method::bdf, Method::exact}) {
    const auto p = failure(*program, run, {.until = 1, .method = method});
    EXPECT_EQ(p.code, "loop_unsolved");
    EXPECT_NE(p.what.find("gain one"), std::string::npos) << p.what;
    EXPECT_NE(p.what.find("v -> same -> v"), std::string::npos) << p.what;
  }
}

TEST(Loops, ATroubleBeforeTheLoopIsNotBlamedOnIt) {
  const auto program = compiled(feedback(block("gain", {{"gain", 2.0}}, {"error"})));
  auto run = start(*program);
  bind_input(*program, run, "u", series({0, 1}, {0, std::numeric_limits<double>::infinity()}));
  EXPECT_NE(failure(*program, run, {.until = 1, .method = Method::bdf}).code, "loop_unsolved");
}

TEST(Loops, ADiagramMayForbidThem) {
  auto d = feedback(block("gain", {{"gain", 2.0}}, {"error"}));
  d.simulate.loops = "solve";
  EXPECT_NO_THROW(compiled(d));
  d.simulate.loops = "error";
  try {
    compiled(d);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().code, "algebraic_loop");
    EXPECT_NE(e.problems.front().what.find(" -> "), std::string::npos);
  }
}

TEST(Loops, AGuessThatNobodyUsesOrOfAnotherUnitIsAnError) {
  const auto code = [](const std::string& signal, const Number& number) {
    auto d = folded();
    d.blocks["after"] = block("gain", {{"gain", 2.0}}, {"v"});
    d.record = {"after"};
    d.simulate.guess[signal] = number;
    try {
      compiled(d);
    } catch (const Error& e) {
      EXPECT_EQ(e.problems.front().path, "/simulate/guess/" + signal);
      return e.problems.front().code;
    }
    return std::string();
  };
  EXPECT_EQ(code("v", Number{1, "V"}), "");
  EXPECT_EQ(code("square", Number{1, "V^2"}), "") << "any signal of the loop may be the one that is guessed";
  EXPECT_EQ(code("after", Number{1, "V"}), "unused_guess");
  EXPECT_EQ(code("w", Number{1, "V"}), "unknown_signal");
  EXPECT_EQ(code("v", Number{1, "um"}), "wrong_unit");
  EXPECT_EQ(code("v", Number{1, {}}), "wrong_unit");
}

// --- row by row
// -------------------------------------------------------------------------------------------------------

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
