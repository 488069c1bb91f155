// What is true or false: gates by their tables, and instants that are located, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/blocks/bench.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using bench::Bench;
using tools::block;

Traces run_of(const Diagram& d, double until, Method method = Method::automatic) {
  const auto program = tools::compiled(d);
  SimulateOptions options;
  options.until = until;
  options.method = method;
  return simulate(*program, start(*program), options);
}
Node sine(double amplitude = 1, const std::string& frequency = "1 Hz", double offset = 0) {
  return block("sine", {{"amplitude", amplitude}, {"frequency", frequency}, {"offset", offset}});
}
Node constant(double value) { return block("constant", {{"value", value}}); }

TEST(Logic, GatesHaveTheirTables) {
  const std::vector<std::vector<int>> tables{{0, 0, 0, 1}, {0, 1, 1, 1}, {1, 1, 1, 0}, {1, 0, 0, 0}, {0, 1, 1, 0}};
  for (std::size_t is = 0; is < tables.size(); ++is)
    for (int row = 0; row < 4; ++row)
      EXPECT_EQ(Bench("logic", {{"is", {static_cast<double>(is)}}}, 2)
                    .output(0, {static_cast<double>(row / 2), static_cast<double>(row % 2)})[0],
                tables[is][static_cast<std::size_t>(row)])
          << is << " " << row;
  EXPECT_EQ(Bench("logic", {{"is", {5}}}, 1).output(0, {0})[0], 1);
  EXPECT_EQ(Bench("logic", {{"is", {5}}}, 1).output(0, {1})[0], 0);
  EXPECT_NE(Bench("logic", {{"is", {5}}}, 2).sizes.error.find("one input"), std::string::npos);
}

TEST(Logic, RelationsAreWhatTheyAreCalled) {
  const auto is = [](int relation, double a, double b) {
    return Bench("compare", {{"is", {static_cast<double>(relation)}}}).output(0, {a, b})[0];
  };
  for (const auto& [a, b] : {std::pair{1.0, 2.0}, std::pair{2.0, 1.0}, std::pair{2.0, 2.0}}) {
    EXPECT_EQ(is(0, a, b), a < b);
    EXPECT_EQ(is(1, a, b), a <= b);
    EXPECT_EQ(is(2, a, b), a == b);
    EXPECT_EQ(is(3, a, b), a != b);
    EXPECT_EQ(is(4, a, b), a >= b);
    EXPECT_EQ(is(5, a, b), a > b);
  }
}

/// A sine is above the level c for the share 1/2 - asin(c)/pi of its turn.
TEST(Logic, LevelsAreSteppedOverByNoIntegrator) {
  const double share = 0.5 - std::asin(0.98) / M_PI;
  const auto d =
      tools::diagram({{"s", sine()},
                      {"level", constant(0.98)},
                      {"compared", block("compare", {{"is", "greater"}}, {"s", "level"})},
                      {"other", block("comparator", {{"level", 0.98}, {"above", 1.0}, {"below", 0.0}}, {"s"})},
                      {"two", block("logic", {}, {"compared", "other"})},
                      {"switched", block("switch", {}, {"level", "two", "s"})},
                      {"a", block("integrator", {}, {"compared"})},
                      {"b", block("integrator", {}, {"other"})},
                      {"c", block("integrator", {}, {"two"})},
                      {"d", block("integrator", {}, {"switched"})}},
                     {"a", "b", "c", "d"});
  for (const Method method : {Method::bdf, Method::adams, Method::runge_kutta}) {
    const auto traces = run_of(d, 5, method);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(tools::trace(traces, i).back(), 5 * share, 1e-5) << i << method_name(method);
    // the sine without its tops, and the level there: - 2 cos(asin c)/(2 pi) + c share per turn
    EXPECT_NEAR(tools::trace(traces, 3).back(), 5 * (0.98 * share - std::cos(std::asin(0.98)) / M_PI), 1e-5);
  }
}

TEST(Logic, ASampleIsTakenWhereTheTriggerRises) {
  // trigger rises where sin = 0.5: t = 1/12 + k; held is a sine of another frequency there
  const auto d = tools::diagram({{"u", sine(1, "0.3 Hz")},
                                 {"trigger", sine()},
                                 {"rising", block("sample_and_hold", {{"initial", 7.0}}, {"u", "trigger"})},
                                 {"either", block("sample_and_hold", {{"edge", "either"}}, {"u", "trigger"})},
                                 {"i", block("integrator", {}, {"rising"})}},
                                {"rising", "either", "i"});
  const auto at = [](double t) { return std::sin(2 * M_PI * 0.3 * t); };
  const auto traces = run_of(d, 2.3);
  EXPECT_NEAR(tools::trace(traces, 0).back(), at(2 + 1.0 / 12),
              1e-6);  // the level is met to 1e-6, the sine has a slope of 2
  EXPECT_NEAR(tools::trace(traces, 0).front(), 7, 0);
  // true again just below the level: 1e-6 / (2 pi cos(pi/6)) late
  EXPECT_NEAR(tools::trace(run_of(d, 0.6), 1).back(), at(5.0 / 12), 2e-6);
  const double right = 7.0 / 12 + at(1.0 / 12) + at(13.0 / 12) + (2.3 - 25.0 / 12) * at(25.0 / 12);
  EXPECT_NEAR(tools::trace(traces, 2).back(), right, 1e-5);
}

TEST(Logic, ACounterCountsAndBeginsAgain) {
  const auto d = tools::diagram({{"u", sine()},
                                 {"clear", block("step", {{"before", 0.0}, {"after", 1.0}, {"time", "3.5 s"}})},
                                 {"again", block("step", {{"before", 0.0}, {"after", -1.0}, {"time", "4 s"}})},
                                 {"reset", block("sum", {}, {"clear", "again"})},
                                 {"n", block("counter", {{"initial", 10.0}, {"by", 2.0}}, {"u", "reset"})}},
                                {"n"});
  EXPECT_EQ(tools::trace(run_of(d, 0.05)).back(), 10);
  EXPECT_EQ(tools::trace(run_of(d, 3.4)).back(), 18);  // four edges
  EXPECT_EQ(tools::trace(run_of(d, 3.9)).back(), 10);
  EXPECT_EQ(tools::trace(run_of(d, 5.4)).back(), 14);
}

TEST(Logic, WhatIsTrueAtTheStartIsNoEdge) {
  const auto d = tools::diagram({{"u", constant(1)},
                                 {"never", constant(0)},
                                 {"n", block("counter", {}, {"u", "never"})},
                                 {"t", block("timer", {}, {"u"})}},
                                {"n", "t"});
  const auto traces = run_of(d, 2);
  EXPECT_EQ(tools::trace(traces, 0).back(), 0);
  EXPECT_NEAR(tools::trace(traces, 1).back(), 2, 1e-9);
}

TEST(Logic, ATimerRunsWhileItsInputIsTrue) {
  const auto d = tools::diagram({{"u", sine()}, {"t", block("timer", {}, {"u"})}}, {"t"});
  EXPECT_NEAR(tools::trace(run_of(d, 0.3)).back(), 0.3 - 1.0 / 12, 1e-6);
  EXPECT_EQ(tools::trace(run_of(d, 0.9)).back(), 0);
  EXPECT_NEAR(tools::trace(run_of(d, 3.2)).back(), 0.2 - 1.0 / 12, 1e-6);
}

TEST(Logic, AnEdgeIsTrueForOneSample) {
  Bench b("edge", {{"period", {0.1}}});
  const std::vector<bench::Numbers> u{{1}, {1}, {0}, {1}, {1}, {0}};
  EXPECT_EQ(b.response(u, 0.1), (bench::Numbers{0, 0, 0, 1, 0, 0}));
  Bench falling("edge", {{"edge", {1}}, {"period", {0.1}}});
  EXPECT_EQ(falling.response(u, 0.1), (bench::Numbers{0, 0, 1, 0, 0, 1}));
}

TEST(MathBlocks, AreWhatTheyAreCalled) {
  EXPECT_EQ(Bench("divide", {}).output(0, {3, 4})[0], 0.75);
  EXPECT_EQ(Bench("abs", {}).output(0, {-3})[0], 3);
  EXPECT_EQ(Bench("sign", {}).output(0, {-3})[0], -1);
  EXPECT_EQ(Bench("sign", {}).output(0, {0})[0], 0);
  EXPECT_EQ(Bench("min_max", {}, 3).output(0, {1, 5, 2})[0], 5);
  EXPECT_EQ(Bench("min_max", {{"is", {1}}}, 3).output(0, {1, 5, 2})[0], 1);
  EXPECT_EQ(Bench("manual_switch", {{"position", {1}}}).output(0, {1, 5})[0], 5);
  const std::vector<double (*)(double)> functions{std::sin, std::cos, std::tan, std::asin, std::acos, std::atan};
  for (std::size_t i = 0; i < functions.size(); ++i)
    EXPECT_EQ(Bench("trigonometry", {{"function", {static_cast<double>(i)}}}, 1).output(0, {0.4})[0],
              functions[i](0.4));
  EXPECT_EQ(Bench("trigonometry", {{"function", {6}}}, 2).output(0, {0.4, -0.3})[0], std::atan2(0.4, -0.3));
  EXPECT_EQ(Bench("trigonometry", {{"function", {9}}}, 1).output(0, {0.4})[0], std::tanh(0.4));
  EXPECT_NE(Bench("trigonometry", {{"function", {6}}}, 1).sizes.error.find("two inputs"), std::string::npos);
}

TEST(MathBlocks, TrigonometryKnowsAngles) {
  const auto unit = [](const char* function, const char* in) {
    const auto p = tools::compiled(
        tools::diagram({{"y", block("trigonometry", {{"function", function}}, {"u"})}}, {"y"}, {{"u", in}}));
    return to_text(p->signals[static_cast<std::size_t>(p->signal("y"))].dimension);
  };
  EXPECT_EQ(unit("sin", "rad"), "1");
  EXPECT_EQ(unit("sin", ""), "1");
  EXPECT_EQ(unit("asin", ""), to_text(parse_unit("rad").dimension));
  EXPECT_THROW(unit("sin", "V"), Error);
  EXPECT_THROW(unit("asin", "V"), Error);
}

}  // namespace
}  // namespace hysteron
