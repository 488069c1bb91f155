// Loops through rates: laws in their own feedback, jumps, sampled diagrams.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/engine/event_blocks.h"
#include "tests/engine/loop_diagrams.h"

namespace hysteron {
namespace {

using namespace tools;
using std::numbers::pi;

/// z of a Bouc-Wen law driven by u with u' = r' / (divisor - gain * A), A = dz/du of the active branch: the loop of
/// rates solved by hand.
std::vector<double> by_hand(const BoucWenNumbers& p, double divisor, double gain, const std::vector<double>& t,
                            double (*rate)(double)) {
  return integrated_by_hand(t, 40, [&](double time, double z, std::size_t) {
    const double r = rate(time);
    // The divisor is positive, so u' has the sign of r'.
    const double a = p.alpha - p.beta * (r >= 0 ? z : -z) - p.gamma * std::abs(z);
    return a * r / (divisor - gain * a);
  });
}

double cosine_rate(double t) { return 3 * 2 * pi * 5 * std::sin(2 * pi * 5 * t); }  // of 3 (1 - cos(2 pi 5 t))

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

}  // namespace
}  // namespace hysteron
