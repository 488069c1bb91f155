// Sources of motion and control: their corners end the steps of every integrator, their integrals are closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/diagram/error.h"
#include "tests/blocks/samples.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using bench::Bench;
using tools::block;
using tools::list;

const bench::Samples motion_sources{
    {"ramp", {{"slope", {2}}, {"time", {0.2}}, {"duration", {0.5}}, {"initial", {1}}}},
    {"pulse", {{"low", {-1}}, {"high", {2}}, {"period", {0.3}}, {"duty", {0.4}}, {"time", {0.1}}}},
    {"trapezoid", {{"low", {-1}}, {"high", {2}}, {"rise", {0.1}}, {"top", {0.05}}, {"fall", {0.2}}, {"period", {0.4}}}},
    {"motion_profile",
     {{"positions", {2, -1, -1.01}},
      {"velocity", {20}},
      {"acceleration", {90}},
      {"jerk", {900}},
      {"dwell", {0.05}},
      {"time", {0.1}},
      {"initial", {0.5}}}},
    {"noise", {{"rms", {2}}, {"bandwidth", {2}}, {"seed", {3}}, {"offset", {1}}}},
    {"noise", {{"rms", {2}}, {"bandwidth", {2}}, {"seed", {3}}, {"between_numbers", {1}}}},
    {"time_table", {{"times", {0.1, 0.2, 0.45, 0.7}}, {"values", {1, -1, 2, 0.5}}}},
    {"time_table", {{"times", {0.1, 0.2, 0.35, 0.4, 0.7}}, {"values", {1, -1, 2, 0.5, 3}}, {"between_points", {2}}}},
    {"time_table", {{"times", {0.1, 0.2, 0.35}}, {"values", {1, -1, 2}}, {"repeat", {1}}}}};

constexpr double never = std::numeric_limits<double>::infinity();
constexpr Method methods[] = {Method::bdf, Method::adams, Method::runge_kutta};

Traces simulated(const Diagram& d, double until, Method method) {
  const auto program = tools::compiled(d);
  SimulateOptions options;
  options.until = until;
  options.every = until / 50;
  options.method = method;
  options.relative_tolerance = 1e-8;
  return simulate(*program, start(*program), options);
}

/// Area under a source after `until` [s], by each method.
void expect_area(const Node& source, double until, double area, double tolerance) {
  for (const Method method : methods) {
    const auto d = tools::diagram({{"u", source}, {"y", block("integrator", {}, {"u"})}}, {"y"});
    EXPECT_NEAR(simulated(d, until, method).values[0].back(), area, tolerance) << source.type << method_name(method);
  }
}

TEST(MotionSources, AreasArePiecesOfStraightLines) {
  // Ramp of 2/s from 0.31 s for 0.5 s: 0.25 + 1 (1.7 - 0.81) and 3 * 1.7 beneath it.
  expect_area(block("ramp", {{"slope", "2 V/s"}, {"time", "0.31 s"}, {"duration", "0.5 s"}, {"initial", "3 V"}}), 1.7,
              0.25 + 0.89 + 5.1, 1e-7);
  // Pulses of 0.12 s each 0.3 s from 0.1 s: five whole ones and 0.1 s of the sixth until 1.7 s; -1 V between.
  expect_area(block("pulse", {{"low", "-1 V"}, {"high", "2 V"}, {"period", "0.3 s"}, {"duty", 0.4}, {"time", "0.1 s"}}),
              1.7, 3 * (5 * 0.12 + 0.1) - 1.7, 1e-7);
  // Trapezoids of (0.1/2 + 0.2 + 0.3/2) V s each 0.8 s from 0.05 s, two whole ones until 1.65 s.
  expect_area(block("trapezoid", {{"high", "1 V"},
                                  {"rise", "0.1 s"},
                                  {"top", "0.2 s"},
                                  {"fall", "0.3 s"},
                                  {"period", "0.8 s"},
                                  {"time", "0.05 s"}}),
              1.65, 0.8, 1e-7);
}

TEST(MotionSources, AProfilesAccelerationIntegratedTwiceIsItsPosition) {
  // Long, short and very short moves one behind the other: what it tells as acceleration leads where it says.
  const auto d = tools::diagram({{"r", block("motion_profile", {{"positions", list({100, 20, 20.4, 20.4, 0}, "mm")},
                                                                {"velocity", "200 mm/s"},
                                                                {"acceleration", "3 m/s^2"},
                                                                {"jerk", "80 m/s^3"},
                                                                {"dwell", "50 ms"},
                                                                {"time", "0.1 s"},
                                                                {"initial", "5 mm"}})},
                                 {"v", block("integrator", {}, {"r.acceleration"})},
                                 {"x", block("integrator", {{"initial", "5 mm"}}, {"v"})}},
                                {"r.position", "r.velocity", "v", "x"});
  for (const Method method : methods) {
    const auto traces = simulated(d, 2.2, method);
    // 1e-8 of 0.2 m/s and of 0.1 m, a hundred steps and more.
    EXPECT_LT(tools::distance(traces.values[1], traces.values[2]), 2e-8) << method_name(method);
    EXPECT_LT(tools::distance(traces.values[0], traces.values[3]), 2e-8) << method_name(method);
    EXPECT_NEAR(traces.values[0].back(), 0, 1e-17) << "it has arrived, exactly";
  }
}

TEST(MotionSources, AProfileNamesTheCornersOfEveryMoveOnce) {
  const Bench b("motion_profile", {{"positions", {1, 1, 0.5, 0.4999}},
                                   {"velocity", {0.5}},
                                   {"acceleration", {2}},
                                   {"jerk", {40}},
                                   {"dwell", {0.2}},
                                   {"time", {0.3}}});
  double t = -1, last = b.output(-1)[2];
  int corners = 0;
  for (; b.next_breakpoint(t) < never; ++corners) {
    const double next = b.next_breakpoint(t), middle = t + (next - t) / 2;
    ASSERT_GT(next, t);
    for (std::size_t i = 0; i < 3; ++i)  // both pieces meet, by rounding of times below 10 s times the jerk
      ASSERT_NEAR(b.output(next, middle, {}, {}, {})[i], b.output(next, next, {}, {}, {})[i], 1e-15 * 40 * 10);
    t = next;
    last = b.output(t + 1e-3)[0];
  }
  EXPECT_GE(corners, 8 + 8 + 4);  // 1 m and 0.5 m cruise, 0.1 mm jerks only
  EXPECT_EQ(last, 0.4999);
  EXPECT_EQ(b.output(0.2)[0], 0);
  // The second place is the first: it waits there for two dwells, 0.3 + (1/0.5 + 0.3) s on.
  EXPECT_EQ(b.output(2.6 + 0.39)[0], 1);
  EXPECT_LT(b.output(2.6 + 0.45)[0], 1);
}

TEST(MotionSources, AnSCurveWithoutJerkIsRefusedWithItsCure) {
  const Bench b("motion_profile", {{"positions", {1}}, {"velocity", {1}}, {"acceleration", {1}}});
  EXPECT_NE(b.check().find("\"jerk\""), std::string::npos);
  EXPECT_EQ(
      Bench("motion_profile", {{"positions", {1}}, {"velocity", {1}}, {"acceleration", {1}}, {"profile", {1}}}).check(),
      "");
}

TEST(MotionSources, ATableMovesAsItSays) {
  const Bench::Values points{{"times", {1, 2, 4}}, {"values", {3, 5, -1}}};
  const auto with = [&](const char* key, double choice) {
    auto values = points;
    values[key] = {choice};
    return Bench("time_table", values);
  };
  const Bench linear("time_table", points), hold = with("between_points", 1), again = with("repeat", 1);
  EXPECT_EQ(linear.output(0)[0], 3);
  EXPECT_EQ(linear.output(1.5)[0], 4);
  EXPECT_EQ(linear.output(3)[0], 2);
  EXPECT_EQ(linear.output(9)[0], -1);
  EXPECT_EQ(hold.output(3.999)[0], 5);
  EXPECT_EQ(hold.output(4)[0], -1);
  EXPECT_EQ(linear.next_breakpoint(2), 4);
  EXPECT_EQ(linear.next_breakpoint(4), never);
  EXPECT_EQ(again.output(0)[0], 3) << "constant before the first point";
  EXPECT_EQ(again.output(4)[0], 3) << "the first point again";
  EXPECT_EQ(again.output(1 + 3 * 7 + 0.5)[0], 4);
  EXPECT_EQ(again.next_breakpoint(4), 5);
  EXPECT_EQ(again.next_breakpoint(5), 7);
  EXPECT_EQ(again.sizes.smoothness, Smoothness::jumps);
  EXPECT_EQ(linear.sizes.smoothness, Smoothness::smooth);
  // Over and over until 10 s: two rounds of (4 + 4) V s before 7 s, one behind, 3 V s before the first point.
  expect_area(
      block("time_table", {{"times", list({1, 2, 4}, "s")}, {"values", list({3, 5, -1}, "V")}, {"repeat", "yes"}}), 10,
      3 + 3 * 8, 1e-6);
}

TEST(MotionSources, NoiseIsOneForASeedAndHasItsRootMeanSquare) {
  for (const double choice : {0.0, 1.0}) {
    Bench::Values values{{"rms", {2}}, {"bandwidth", {10}}, {"seed", {4}}, {"between_numbers", {choice}}};
    const Bench b("noise", values);
    double squares = 0;
    const int n = 40000;
    for (int i = 0; i < n; ++i) squares += std::pow(b.output(0.0137 * i)[0], 2);
    // Some 12 000 independent numbers within 548 s: five standard errors of 4/sqrt(6000).
    EXPECT_NEAR(squares / n, 4, 5 * 4 / std::sqrt(6000.0)) << choice;
    values["seed"] = {5};
    EXPECT_NE(Bench("noise", values).output(0.3)[0], b.output(0.3)[0]);
    EXPECT_EQ(Bench("noise", {{"rms", {2}}, {"bandwidth", {10}}, {"seed", {4}}, {"between_numbers", {choice}}})
                  .output(0.3)[0],
              b.output(0.3)[0]);
  }
  EXPECT_NE(Bench("noise", {{"rms", {1}}, {"bandwidth", {1}}, {"seed", {0.5}}}).check(), "");
}

TEST(MotionSources, NoiseIsIntegratedAsItIs) {
  // Against a sum of its own values at midpoints, 20 us apart: its second rate, some 4 (2 pi 30 Hz)^2, leaves 1e-8.
  for (const char* between : {"smooth", "hold"}) {
    const auto d = tools::diagram(
        {{"u",
          block("noise",
                {{"rms", "1 V"}, {"bandwidth", "30 Hz"}, {"seed", 6.0}, {"between_numbers", std::string(between)}})},
         {"y", block("integrator", {}, {"u"})}},
        {"y"});
    const auto program = tools::compiled(d);
    Bench b("noise", {{"rms", {1}},
                      {"bandwidth", {30}},
                      {"seed", {6}},
                      {"between_numbers", {between == std::string("hold") ? 1.0 : 0.0}}});
    b.key = program->blocks[static_cast<std::size_t>(program->block_index("u"))].key;
    double sum = 0;
    for (int i = 0; i < 100000; ++i) sum += 2e-5 * b.output(2e-5 * (i + 0.5))[0];
    // Held numbers: each of 135 jumps is off by half a midpoint at most, 1e-5 V s, in either way.
    for (const Method method : methods)
      EXPECT_NEAR(simulated(d, 2, method).values[0].back(), sum, between == std::string("hold") ? 4e-4 : 1e-6);
  }
}

}  // namespace
}  // namespace hysteron
