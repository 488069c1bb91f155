// What simulate() returns for diagrams whose solution is known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;
using std::numbers::pi;

/// Response of a pole of time constant tau at rest to sin(w t), from t = 0.
double lagged_sine(double t, double w, double tau) {
  const double a = w * tau;
  return (std::sin(w * t) - a * std::cos(w * t) + a * std::exp(-t / tau)) / (1 + a * a);
}

class EachMethod : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Simulate, EachMethod, testing::Values(Method::bdf, Method::adams));

TEST_P(EachMethod, ALagFollowsASineAsTheClosedFormSays) {
  const auto program = compiled(diagram({{"u", block("sine", {{"amplitude", "2 V"}, {"frequency", "5 Hz"}})},
                                         {"y", block("lag", {{"times", list({0.02}, "s")}}, {"u"})}},
                                        {"y"}));
  SimulateOptions options{.until = 0.6, .method = GetParam(), .relative_tolerance = 1e-8};
  const auto traces = simulate(*program, start(*program), options);
  ASSERT_EQ(traces.t.size(), 1001U);
  std::vector<double> expected;
  for (const double t : traces.t) expected.push_back(2 * lagged_sine(t, 2 * pi * 5, 0.02));
  EXPECT_LT(distance(trace(traces), expected), 20 * 1e-8 * 2);  // local errors add up over a time constant
}

TEST_P(EachMethod, AnOscillatorOfTwoIntegratorsKeepsItsPhase) {
  // x'' = -w^2 x written as a loop over two integrators; x(0) = 1 m.
  const auto program = compiled(diagram({{"v", block("integrator", {}, {"a"})},
                                         {"x", block("integrator", {{"initial", "1 m"}}, {"v"})},
                                         {"a", block("gain", {{"gain", "-900 1/s^2"}}, {"x"})}},
                                        {"x"}));
  SimulateOptions options{.until = 1, .method = GetParam(), .relative_tolerance = 1e-9};
  const auto traces = simulate(*program, start(*program), options);
  std::vector<double> expected;
  for (const double t : traces.t) expected.push_back(std::cos(30 * t));
  // An undamped loop remembers every local error: a thousand steps of the tolerance.
  EXPECT_LT(distance(trace(traces), expected), 3e-6);
}

TEST_P(EachMethod, AStepThroughTwoPolesNeedsNoOutputNearTheJump) {
  const auto program = compiled(diagram({{"u", block("step", {{"after", "1 V"}, {"time", "0.1234567 s"}})},
                                         {"y", block("lag", {{"times", list({0.01, 0.02}, "s")}}, {"u"})}},
                                        {"u", "y"}));
  SimulateOptions options{.until = 0.5, .every = 0.05, .method = GetParam(), .relative_tolerance = 1e-9};
  const auto traces = simulate(*program, start(*program), options);
  for (std::size_t k = 0; k < traces.t.size(); ++k) {
    const double s = traces.t[k] - 0.1234567;
    EXPECT_EQ(trace(traces, 0)[k], s >= 0 ? 1 : 0);
    const double y = s <= 0 ? 0 : 1 - (0.02 * std::exp(-s / 0.02) - 0.01 * std::exp(-s / 0.01)) / (0.02 - 0.01);
    EXPECT_NEAR(trace(traces, 1)[k], y, 20e-9);
  }
}

TEST_P(EachMethod, ARecordedInputIsIntegratedPieceByPiece) {
  // A lag behind straight lines: exact per piece, from u + tau u' relaxing.
  const std::vector<double> t{0, 0.1, 0.15, 0.4, 0.5}, v{0, 2, -1, -1, 3};
  const double tau = 0.03;
  auto d = diagram({{"y", block("lag", {{"times", list({tau}, "s")}}, {"u"})}}, {"y"}, {{"u", "V"}});
  const auto program = compiled(d);
  auto run = start(*program);
  bind_input(*program, run, "u", series(t, v));
  SimulateOptions options{.method = GetParam(), .relative_tolerance = 1e-9};
  options.instants = t;
  const auto traces = simulate(*program, run, options);
  double y = 0;
  for (std::size_t k = 0; k + 1 < t.size(); ++k) {
    EXPECT_NEAR(trace(traces)[k], y, 100e-9) << "row " << k;
    const double h = t[k + 1] - t[k], slope = (v[k + 1] - v[k]) / h;
    y = v[k + 1] - tau * slope + (y - v[k] + tau * slope) * std::exp(-h / tau);
  }
  EXPECT_NEAR(trace(traces).back(), y, 100e-9);
}

TEST_P(EachMethod, AHeldInputIsAStaircase) {
  const std::vector<double> t{0, 0.1, 0.2, 0.4}, v{1, 3, -2, 0};
  const double tau = 0.05;
  auto d = diagram({{"y", block("lag", {{"times", list({tau}, "s")}}, {"u"})}}, {"u", "y"}, {{"u", "V"}});
  const auto program = compiled(d);
  auto run = start(*program);
  bind_input(*program, run, "u", series(t, v, Between::hold));
  SimulateOptions options{.method = GetParam(), .relative_tolerance = 1e-9};
  options.instants = {0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6};
  const auto traces = simulate(*program, run, options);
  const std::vector<double> held{1, 1, 3, 3, -2, -2, 0, 0};
  EXPECT_EQ(trace(traces, 0), held);  // from the right at each sample
  double y = 0;
  for (std::size_t k = 0; k < options.instants.size(); ++k) {
    EXPECT_NEAR(trace(traces, 1)[k], y, 100e-9) << "t = " << options.instants[k];
    if (k + 1 < held.size())
      y = held[k] + (y - held[k]) * std::exp(-(options.instants[k + 1] - options.instants[k]) / tau);
  }
}

/// z of Bouc-Wen (n = 1) after the input has moved by `du` from `z` in one direction; SPEC 2.3: with q = d z, x = |u|,
/// dq/dx = alpha - beta q - gamma |q|.
double bouc_wen_branch(double z, double du, double alpha, double beta, double gamma) {
  const double direction = du < 0 ? -1 : 1;
  double q = direction * z, x = std::abs(du);
  if (q < 0) {
    const double rate = beta - gamma, end = alpha / rate, to_zero = std::log((end - q) / end) / rate;
    if (x <= to_zero) return direction * (end - (end - q) * std::exp(-rate * x));
    x -= to_zero;
    q = 0;
  }
  const double rate = beta + gamma, end = alpha / rate;
  return direction * (end - (end - q) * std::exp(-rate * x));
}

TEST_P(EachMethod, ARecordingThroughBoucWenTurnsSharplyAtItsSamples) {
  const auto program = compiled(diagram({{"y", thesis_bouc_wen("u")}}, {"y"}, {{"u", "V"}}));
  std::vector<double> t, u, expected;
  double z = 0;
  for (int k = 0; k <= 300; ++k) {
    t.push_back(0.001 * k);
    u.push_back(3 - 3 * std::cos(2.3 * k) + 0.01 * (k % 7) - 0.01 * std::cos(2.3 * k));
    if (k == 0) u[0] = 0;
    if (k > 0) z = bouc_wen_branch(z, u.back() - u[u.size() - 2], 0.6187, 0.2418, 0.0237);
    expected.push_back((1.6126 * u.back() - z) * 1e-6);
  }
  auto run = start(*program);
  bind_input(*program, run, "u", series(t, u));
  for (const double tolerance : {1e-4, 1e-7}) {
    SimulateOptions options{.method = GetParam(), .relative_tolerance = tolerance};
    options.instants = t;
    EXPECT_LT(distance(trace(simulate(*program, run, options)), expected), 5 * tolerance * largest(expected));
  }
}

TEST(Simulate, AHeldSampleThatDecidesNothingDoesNotRestartTheIntegrator) {
  auto d = diagram({{"w", block("sine", {{"amplitude", "1 V"}, {"frequency", "1 Hz"}})},
                    {"y", block("lag", {{"times", list({0.05}, "s")}}, {"w"})},
                    {"z", block("sum", {}, {"y", "u"})}},
                   {"z"}, {{"u", "V"}});
  const auto program = compiled(d);
  auto run = start(*program);
  bind_input(*program, run, "u", series(grid(0, 1, 100), std::vector<double>(101, 1.0), Between::hold));
  const auto traces = simulate(*program, run, {.until = 1, .method = Method::bdf});
  EXPECT_EQ(traces.statistics.restarts, 0);
}

TEST(Simulate, ALinearRecordingStopsTheIntegratorAtEachSampleButDoesNotRestartIt) {
  auto d = diagram({{"y", block("lag", {{"times", list({0.5}, "s")}}, {"u"})}}, {"y"}, {{"u", "V"}});
  const auto program = compiled(d);
  auto run = start(*program);
  const auto t = grid(0, 1, 50);
  std::vector<double> v;
  for (const double s : t) v.push_back(std::sin(2 * pi * s));
  bind_input(*program, run, "u", series(t, v));
  const auto traces = simulate(*program, run, {.until = 1, .method = Method::bdf});
  EXPECT_GE(traces.statistics.steps, 50);
  EXPECT_EQ(traces.statistics.restarts, 0);
}

TEST(Simulate, DiagramsWithoutStatesAreEvaluatedAtTheInstants) {
  const auto program = compiled(diagram({{"u", block("sine", {{"amplitude", "1 V"}, {"frequency", "3 Hz"}})},
                                         {"y", block("gain", {{"gain", "2 um/V"}}, {"u"})}},
                                        {"y"}));
  const auto traces = simulate(*program, start(*program), {.until = 1});
  for (std::size_t k = 0; k < traces.t.size(); ++k)
    EXPECT_NEAR(trace(traces)[k], 2e-6 * std::sin(2 * pi * 3 * traces.t[k]), 1e-20);  // rounding of 2e-6
}

TEST(Simulate, ATriangleDrivesPlayOperatorsWithoutLosingItsPeaks) {
  // Output of a play of radius r for a triangle 0..6 V: 6 - r on top, r at the bottom; rows do not hit the peaks.
  const auto program = compiled(
      diagram({{"u", thesis_wave("triangle", "3 V")}, {"y", block("play", {{"radius", "1 V"}}, {"u"})}}, {"y"}));
  SimulateOptions options{.until = 0.999};
  options.instants = {0.137, 0.1731, 0.333, 0.3967, 0.5311};
  const auto traces = simulate(*program, start(*program), options);
  const auto u = [](double t) { return 12 * std::abs(5 * t - std::floor(5 * t + 0.5)); };
  EXPECT_NEAR(trace(traces)[0], std::min(u(0.137) + 1, 5.0), 1e-12);
  EXPECT_NEAR(trace(traces)[1], u(0.1731) + 1, 1e-12);
  EXPECT_NEAR(trace(traces)[2], std::min(u(0.333) + 1, 5.0), 1e-12);
  EXPECT_NEAR(trace(traces)[3], std::max(u(0.3967) + 1, 1.0), 1e-12);
  EXPECT_NEAR(trace(traces)[4], std::min(u(0.5311) + 1, 5.0), 1e-12);
}

TEST_P(EachMethod, ADeadTimeOfASmoothSignalIsItsPast) {
  // The delayed signal comes from a lag, so that its past is made of integrator steps, not of a formula.
  const auto program = compiled(diagram({{"u", block("sine", {{"amplitude", "1 V"}, {"frequency", "5 Hz"}})},
                                         {"x", block("lag", {{"times", list({0.02}, "s")}}, {"u"})},
                                         {"y", block("dead_time", {{"delay", "30 ms"}}, {"x"})}},
                                        {"y"}));
  const auto traces =
      simulate(*program, start(*program), {.until = 0.5, .method = GetParam(), .relative_tolerance = 1e-8});
  std::vector<double> expected;
  for (const double t : traces.t) expected.push_back(t < 0.03 ? 0 : lagged_sine(t - 0.03, 2 * pi * 5, 0.02));
  // Cubic interpolation between accepted points: its error is that of the steps at this tolerance, some ten times it.
  EXPECT_LT(distance(trace(traces), expected), 1e-6);
}

TEST(Simulate, ADeadTimeKeepsTheCornersOfATriangle) {
  const auto program = compiled(diagram(
      {{"u", thesis_wave("triangle", "3 V")}, {"y", block("dead_time", {{"delay", "33.3 ms"}}, {"u"})}}, {"y"}));
  const auto traces = simulate(*program, start(*program), {.until = 0.7, .method = Method::bdf});
  std::vector<double> expected;
  for (const double t : traces.t) {
    const double s = std::max(0.0, t - 0.0333);
    expected.push_back(12 * std::abs(5 * s - std::floor(5 * s + 0.5)));
  }
  EXPECT_LT(distance(trace(traces), expected), 1e-12);
}

TEST(Simulate, ADeadTimeOfARecordedSignalIsTheRecordingLater) {
  auto d = diagram({{"y", block("dead_time", {{"delay", "0.07 s"}}, {"u"})}}, {"y"}, {{"u", "V"}});
  const auto program = compiled(d);
  const auto recording = series({0, 0.1, 0.15, 0.4, 0.5}, {1, 2, -1, -1, 3});
  auto run = start(*program);
  bind_input(*program, run, "u", recording);
  const auto traces = simulate(*program, run, {.until = 0.6, .method = Method::bdf});
  std::vector<double> expected;
  for (const double t : traces.t) expected.push_back(recording->value(t - 0.07, t - 0.07));
  EXPECT_LT(distance(trace(traces), expected), 1e-12);
}

TEST(Simulate, AJumpComesOutOfADeadTimeAsAJumpAtTheRightInstant) {
  const auto program = compiled(diagram({{"u", block("step", {{"after", "2 V"}, {"time", "0.1 s"}})},
                                         {"late", block("dead_time", {{"delay", "0.2 s"}}, {"u"})},
                                         {"later", block("dead_time", {{"delay", "0.25 s"}}, {"late"})},
                                         {"y", block("lag", {{"times", list({0.05}, "s")}}, {"later"})}},
                                        {"late", "later", "y"}));
  SimulateOptions options{.until = 1, .method = Method::bdf, .relative_tolerance = 1e-9};
  options.instants = {0, 0.29999, 0.3 + 1e-12, 0.54999, 0.55 + 1e-12, 0.6, 0.9};
  const auto traces = simulate(*program, start(*program), options);
  EXPECT_EQ(trace(traces, 0), (std::vector<double>{0, 0, 2, 2, 2, 2, 2}));
  EXPECT_EQ(trace(traces, 1), (std::vector<double>{0, 0, 0, 0, 2, 2, 2}));
  EXPECT_NEAR(trace(traces, 2)[5], 2 * (1 - std::exp(-1.0)), 100e-9);
  EXPECT_NEAR(trace(traces, 2)[6], 2 * (1 - std::exp(-7.0)), 100e-9);
}

TEST(Simulate, ADelayedFeedbackLoopFollowsTheMethodOfSteps) {
  // x' = 1 - x(t - 1), x = 0 for t <= 0: x = t up to 1, then t - (t - 1)^2 / 2, then ... + (t - 2)^3 / 6.
  const auto program = compiled(diagram({{"one", block("constant", {{"value", "1 V"}})},
                                         {"e", block("sum", {{"signs", "+-"}}, {"one", "late"})},
                                         {"k", block("gain", {{"gain", "1 1/s"}}, {"e"})},
                                         {"x", block("integrator", {}, {"k"})},
                                         {"late", block("dead_time", {{"delay", "1 s"}}, {"x"})}},
                                        {"x"}));
  SimulateOptions options{.until = 3, .method = Method::bdf, .relative_tolerance = 1e-9};
  options.instants = {0.5, 1, 1.5, 2, 2.5, 3};
  const auto traces = simulate(*program, start(*program), options);
  for (std::size_t k = 0; k < options.instants.size(); ++k) {
    const double t = options.instants[k];
    double x = t;
    if (t > 1) x -= std::pow(t - 1, 2) / 2;
    if (t > 2) x += std::pow(t - 2, 3) / 6;
    EXPECT_NEAR(trace(traces)[k], x, 1e-7) << "t = " << t;
  }
}

TEST(Simulate, ASimulationMayBeginAtAnyTime) {
  const auto program = compiled(diagram(
      {{"u", block("sine", {{"amplitude", "1 V"}, {"frequency", "5 Hz"}})}, {"y", block("integrator", {}, {"u"})}},
      {"y"}));
  const auto traces = simulate(*program, start(*program),
                               {.begin = -1.3, .until = -0.3, .method = Method::bdf, .relative_tolerance = 1e-9});
  EXPECT_EQ(traces.t.front(), -1.3);
  EXPECT_EQ(traces.t.back(), -0.3);
  const double w = 2 * pi * 5;
  for (std::size_t k = 0; k < traces.t.size(); ++k)
    EXPECT_NEAR(trace(traces)[k], (std::cos(w * -1.3) - std::cos(w * traces.t[k])) / w, 1e-7);
}

}  // namespace
}  // namespace hysteron
