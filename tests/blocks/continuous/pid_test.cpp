// PID controllers, continuous and sampled: their forms, limits and what these do to the integral, by closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/blocks/samples.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using bench::Bench;
using tools::block;
using tools::Parameters;

const bench::Samples pids{
    {"pid", {{"kp", {2}}, {"ki", {3}}, {"kd", {0.4}}, {"filter", {0.2}}}},
    {"pid",
     {{"form", {2}},
      {"kp", {2}},
      {"integral_time", {0.7}},
      {"derivative_time", {0.4}},
      {"derivative_on", {1}},
      {"setpoint_weight", {0.6}},
      {"lower", {-1}},
      {"upper", {1.5}},
      {"anti_windup", {1}},
      {"rate", {4}},
      {"output_rate", {1}},
      {"follow_time", {0.3}}}},
    {"pid_tracking", {{"kp", {2}}, {"ki", {3}}, {"kd", {0.4}}, {"filter", {0.2}}, {"tracking_time", {0.5}}}},
    {"pid_tracking", {{"form", {1}}, {"kp", {2}}, {"integral_time", {0.7}}, {"lower", {-1}}, {"upper", {1.5}}}},
    {"discrete_pid",
     {{"kp", {2}}, {"ki", {3}}, {"kd", {0.4}}, {"lower", {-1}}, {"upper", {1.5}}, {"rate", {4}}, {"period", {0.1}}}},
    {"discrete_pid_tracking",
     {{"form", {2}}, {"kp", {2}}, {"integral_time", {0.7}}, {"derivative_time", {0.4}}, {"period", {0.1}}}}};

constexpr double rtol = 1e-9;

/// Signals of a diagram in which "r", "m" and maybe "c" are given and "y" is the controller.
Traces pid_response(const Node& reference, const Node& measured, const std::string& type, const Parameters& numbers,
                    std::vector<double> instants, const Node* tracked = nullptr) {
  std::vector<std::pair<std::string, Node>> blocks{{"r", reference}, {"m", measured}};
  if (tracked != nullptr) blocks.emplace_back("c", *tracked);
  blocks.emplace_back("y",
                      tracked != nullptr ? block(type, numbers, {"r", "m", "c"}) : block(type, numbers, {"r", "m"}));
  const auto program = tools::compiled(tools::diagram(blocks, {"y"}));
  SimulateOptions options;
  options.instants = std::move(instants);
  options.until = options.instants.back();
  options.relative_tolerance = rtol;
  return simulate(*program, start(*program), options);
}
Node level(double value, const std::string& unit = "um") {
  return block("constant", {{"value", std::to_string(value) + " " + unit}});
}
const Node none = level(0);

TEST(PidBlock, ParallelOnARampOfTheErrorIsItsThreeParts) {
  const auto t = tools::grid(0, 2, 40);
  const auto traces = pid_response(
      block("ramp", {{"slope", "1 um/s"}}), none, "pid",
      {{"kp", "2 V/um"}, {"ki", "3 V/(um s)"}, {"kd", "0.5 V s/um"}, {"filter", "0.3 s"}, {"derivative_on", "error"}},
      t);
  for (std::size_t k = 0; k < t.size(); ++k)
    EXPECT_NEAR(traces.values[0][k], 2 * t[k] + 1.5 * t[k] * t[k] + 0.5 * (1 - std::exp(-t[k] / 0.3)), 1e-7);
}

TEST(PidBlock, TheDerivativeOfTheMeasuredValueDoesNotSeeTheReferenceJump) {
  const Parameters numbers{{"kp", "2 V/um"}, {"kd", "0.5 V s/um"}, {"filter", "0.3 s"}, {"setpoint_weight", 0.25}};
  const auto jump = block("step", {{"after", "4 um"}, {"time", "0.1 s"}});
  const auto traces = pid_response(jump, none, "pid", numbers, {0.05, 0.1, 0.2, 1});
  EXPECT_EQ(traces.values[0], (std::vector<double>{0, 2, 2, 2})) << "kp times a quarter of 4 um, nothing else";
  const auto moved = pid_response(none, block("ramp", {{"slope", "1 um/s"}}), "pid", numbers, {1, 2});
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_NEAR(moved.values[0][k], -2 * moved.t[k] - 0.5 * (1 - std::exp(-moved.t[k] / 0.3)), 1e-7);
}

TEST(PidBlock, SeriesIsALeadBeforeAPi) {
  // e' = 1 + T_d/T_f E, E = exp(-t/T_f), behind a step of the error; y = kp (e' + (t + T_d (1 - E))/T_i).
  const double kp = 2, ti = 0.7, td = 0.4, tf = 0.1;
  const auto t = tools::grid(0, 2, 40);
  const auto traces = pid_response(level(1), none, "pid",
                                   {{"form", "series"},
                                    {"kp", "2 V/um"},
                                    {"integral_time", "0.7 s"},
                                    {"derivative_time", "0.4 s"},
                                    {"filter", "0.1 s"},
                                    {"derivative_on", "error"}},
                                   t);
  for (std::size_t k = 0; k < t.size(); ++k) {
    const double e = std::exp(-t[k] / tf);
    EXPECT_NEAR(traces.values[0][k], kp * (1 + td / tf * e + (t[k] + td * (1 - e)) / ti), 1e-7);
  }
}

TEST(PidBlock, StandardIsParallelWithItsTimes) {
  const auto source = block("sine", {{"amplitude", "1 um"}, {"frequency", "0.7 Hz"}});
  const auto t = tools::grid(0, 3, 60);
  const auto standard = pid_response(source, none, "pid",
                                     {{"form", "standard"},
                                      {"kp", "2 V/um"},
                                      {"integral_time", "0.5 s"},
                                      {"derivative_time", "0.1 s"},
                                      {"derivative_on", "error"}},
                                     t);
  const auto parallel = pid_response(
      source, none, "pid",
      {{"kp", "2 V/um"}, {"ki", "4 V/(um s)"}, {"kd", "0.2 V s/um"}, {"derivative_on", "error"}, {"filter", "10 ms"}},
      t);
  EXPECT_LT(tools::distance(standard.values[0], parallel.values[0]), 1e-12) << "the filter: a tenth of 0.1 s";
}

TEST(PidBlock, BackCalculationApproachesTheLimitExponentially) {
  // e = 1: above upper = 2 from t = 1/3 s on. There dI/dt = ki e - (kp e + I - upper)/T_t: I goes to upper - kp + ki
  // T_t = 1.6 with T_t, from 1.
  const auto t = tools::grid(0.4, 3, 26);
  const auto traces = pid_response(
      level(1), none, "pid", {{"kp", "1 V/um"}, {"ki", "3 V/(um s)"}, {"upper", "2 V"}, {"tracking_time", "0.2 s"}}, t);
  for (const double y : traces.values[0]) EXPECT_EQ(y, 2);
  // What has been wound up shows where the error turns to -0.2 um: y = I - 0.2 then.
  const auto turned =
      pid_response(block("step", {{"before", "1 um"}, {"after", "-0.2 um"}, {"time", "1 s"}}), none, "pid",
                   {{"kp", "1 V/um"}, {"ki", "3 V/(um s)"}, {"upper", "2 V"}, {"tracking_time", "0.2 s"}}, {1, 1.2});
  const double wound = 1.6 - 0.6 * std::exp(-(1 - 1.0 / 3) / 0.2);
  EXPECT_NEAR(turned.values[0][0], wound - 0.2, 1e-7);
  EXPECT_NEAR(turned.values[0][1], wound - 0.2 - 0.6 * 0.2, 1e-7);
}

TEST(PidBlock, WithoutAntiWindupTheIntegralWindsUp) {
  const auto traces =
      pid_response(block("step", {{"before", "1 um"}, {"after", "-3 um"}, {"time", "1 s"}}), none, "pid",
                   {{"kp", "1 V/um"}, {"ki", "3 V/(um s)"}, {"upper", "2 V"}, {"anti_windup", "none"}}, {1, 1.1});
  EXPECT_NEAR(traces.values[0][0], 3 - 3, 1e-7);
  EXPECT_NEAR(traces.values[0][1], 3 - 3 - 9 * 0.1, 1e-7);
}

TEST(PidBlock, ClampingHoldsTheIntegralAtTheLimitAndDoesNotChatter) {
  // The error falls while the integral grows: P gives in where I pushes, on the limit itself. kp e + I stays within the
  // band, 1e-3 of 4 V, and the run comes to an end.
  const auto d = tools::diagram(
      {{"e", block("ramp", {{"slope", "-1 um/s"}, {"initial", "1.5 um"}})},
       {"zero", none},
       {"y",
        block(
            "pid",
            {{"kp", "1 V/um"}, {"ki", "3 V/(um s)"}, {"lower", "-2 V"}, {"upper", "2 V"}, {"anti_windup", "clamping"}},
            {"e", "zero"})}},
      {"y"});
  const auto program = tools::compiled(d);
  SimulateOptions options;
  options.instants = tools::grid(0, 3, 300);
  options.until = 3;
  options.relative_tolerance = 1e-8;
  const auto traces = simulate(*program, start(*program), options);
  EXPECT_LT(traces.statistics.steps, 5000);
  // Until e = 0.333 um the integral wants to grow faster than P falls (3 e > 1): held; then P wins.
  for (std::size_t k = 0; k < traces.t.size(); ++k) {
    const double t = traces.t[k];
    if (t > 0.3 && t < 1.16) {
      EXPECT_EQ(traces.values[0][k], 2) << t;
    }
  }
  // From e = 1/3 um on it leaves the limit: y' = 3 e - 1, from 2 V (and a band of 4 mV at most).
  const double since = 2.5 - (1.5 - 1.0 / 3);
  EXPECT_NEAR(traces.values[0][250], 2 - 1.5 * since * since, 4.1e-3);
}

TEST(PidBlock, TheIntegralFollowsWhatCommandsInItsPlace) {
  // Tracked 1.7 V with T_t = 0.1 s, no error: what it would command goes there as 1 - exp(-t/T_t), for a change of the
  // commander without a bump.
  const auto other = level(1.7, "V");
  const auto t = tools::grid(0, 1, 20);
  const auto traces = pid_response(level(3), level(3), "pid_tracking",
                                   {{"kp", "2 V/um"}, {"ki", "3 V/(um s)"}, {"tracking_time", "0.1 s"}}, t, &other);
  for (std::size_t k = 0; k < t.size(); ++k) EXPECT_NEAR(traces.values[0][k], 1.7 * (1 - std::exp(-t[k] / 0.1)), 1e-7);
  EXPECT_NEAR(traces.values[0].back(), 1.7, 1.7 * std::exp(-10.0) + 1e-7);
}

TEST(PidBlock, ACommandOfLimitedRateIsARamp) {
  const auto traces =
      pid_response(level(1), none, "pid",
                   {{"kp", "3 V/um"}, {"output_rate", "limited"}, {"rate", "10 V/s"}, {"follow_time", "1 ms"}},
                   {0.1, 0.2, 0.29, 0.4});
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(traces.values[0][k], 10 * traces.t[k], 1e-7);
  EXPECT_NEAR(traces.values[0][3], 3, 1e-7);
}

TEST(DiscretePidBlock, InFastSamplesIsTheContinuousOne) {
  // A loop around a lag of 0.2 s with a limit that is reached: first order in the period, 0.1 ms of 0.05 s.
  const auto loop = [](const std::string& type, Parameters numbers) {
    const Parameters common{{"kp", 6.0},     {"ki", "20 1/s"}, {"kd", "0.1 s"},
                            {"lower", -2.0}, {"upper", 2.0},   {"setpoint_weight", 0.7}};
    numbers.insert(numbers.end(), common.begin(), common.end());
    const auto d = tools::diagram({{"r", block("step", {{"after", 1.0}, {"time", "0.05 s"}})},
                                   {"y", block(type, numbers, {"r", "x"})},
                                   {"x", block("lag", {{"times", tools::list({0.2, 0.03}, "s")}}, {"y"})}},
                                  {"x"});
    const auto program = tools::compiled(d);
    SimulateOptions options;
    options.instants = tools::grid(0, 1, 50);
    options.until = 1;
    options.relative_tolerance = 1e-7;
    return simulate(*program, start(*program), options).values[0];
  };
  const auto continuous = loop("pid", {});
  EXPECT_GT(tools::largest(continuous), 0.9);
  EXPECT_LT(tools::distance(continuous, loop("discrete_pid", {{"period", "0.1 ms"}, {"rule", "trapezoidal"}})), 2e-3);
  EXPECT_LT(tools::distance(continuous, loop("discrete_pid", {{"period", "25 us"}, {"rule", "trapezoidal"}})), 5e-4);
}

TEST(DiscretePidBlock, OfAnErrorIsTheOldOneFromTheSecondInstantOn) {
  // An error that begins at nothing: there are no two ways to begin.
  for (const double windup : {0.0, 1.0, 2.0}) {  // none, clamping, back calculation of the old one
    Bench::Values common{{"kp", {2}},      {"ki", {3}},       {"kd", {0.4}}, {"filter", {0.05}}, {"lower", {-1}},
                         {"upper", {1.5}}, {"period", {0.1}}, {"rule", {2}}, {"initial", {0.3}}};
    auto old = common, now = common;
    old["anti_windup"] = {windup};
    now["anti_windup"] = {2 - windup};
    now["derivative_on"] = {1};
    std::vector<bench::Numbers> e, r;
    for (int k = 0; k < 80; ++k) {
      e.push_back({1.3 * std::sin(0.21 * k)});
      r.push_back({e.back()[0], 0});
    }
    const auto a = Bench("sampled_pid", old).response(e, 0.1), b = Bench("discrete_pid", now).response(r, 0.1);
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-13) << windup << " " << k;
  }
}

TEST(DiscretePidBlock, TheFirstInstantDoesNotKickAndTheRateHoldsFromTheSecond) {
  const Bench b("discrete_pid", {{"kp", {1}}, {"kd", {5}}, {"filter", {0.1}}, {"rate", {2}}, {"period", {0.1}}});
  const auto y = b.response({{7, 3}, {7, 3}, {9, 3}, {9, 3}, {9, 3}, {9, 2}}, 0.1);
  const double expected[] = {4, 4, 4.2, 4.4, 4.6, 4.8};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(y[k], expected[k], 1e-15) << k;
}

TEST(DiscretePidBlock, BumplesslyTakesOverWhatItTracked) {
  // With T_t of one period: what it would command is what it tracked one instant before, whatever the error was.
  const Bench b("discrete_pid_tracking", {{"kp", {2}}, {"ki", {0.5}}, {"tracking_time", {0.1}}, {"period", {0.1}}});
  std::vector<bench::Numbers> u;
  for (int k = 0; k < 30; ++k) u.push_back({1, 0.2, 0.7});
  const auto y = b.response(u, 0.1);
  EXPECT_NEAR(y.back(), 0.7 + 0.5 * 0.1 * 0.8, 1e-14) << "and one increment of its own";
}

TEST(PidBlock, WhatDoesNotGoTogetherIsRefusedWithItsCure) {
  const auto refused = [](const std::string& type, Bench::Values values, const std::string& word) {
    const std::string text = Bench(type, values).check();
    EXPECT_NE(text.find(word), std::string::npos) << text;
    EXPECT_NE(text.find("; "), std::string::npos) << text;
  };
  refused("pid", {{"kp", {1}}, {"integral_time", {1}}}, "\"form\": \"standard\"");
  refused("pid", {{"kp", {1}}, {"ki", {1}}, {"form", {2}}}, "integral_time");
  refused("pid", {{"kp", {1}}, {"lower", {2}}, {"upper", {1}}}, "exchange");
  refused("pid", {{"kp", {1}}, {"anti_windup", {1}}, {"upper", {1}}}, "both limits");
  refused("pid", {{"kp", {1}}, {"rate", {1}}}, "output_rate");
  refused("pid", {{"kp", {0}}, {"kd", {1}}}, "filter");
  refused("pid", {{"kp", {0}}, {"ki", {1}}, {"upper", {1}}}, "tracking_time");
  refused("discrete_pid", {{"kp", {1}}, {"kd", {1}}, {"form", {1}}, {"period", {1}}}, "derivative_time");
}

}  // namespace
}  // namespace hysteron
