// How a run starts: after a past of its inputs, or in equilibrium.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

Diagram with_past(const Node& law, NumberList past) {
  auto d = diagram({{"u", block("constant", {{"value", past.back()}})}, {"y", law}}, {"y"});
  d.simulate.past["y"] = std::move(past);
  return d;
}

double first_value(const Diagram& d) {
  const auto p = compiled(d);
  return trace(simulate(*p, start(*p), {.until = 1e-3, .every = 1e-3, .method = Method::bdf})).front();
}

TEST(Past, OfAPlayOperatorIsWhatItsExtremesLeft) {
  auto law = block("play", {{"radius", "1 V"}}, {"u"});
  const auto volts = [](std::initializer_list<double> values) {
    NumberList list;
    for (const double v : values) list.push_back({v, "V"});
    return list;
  };
  EXPECT_DOUBLE_EQ(first_value(with_past(law, volts({0, 5, 4.5}))), 4);     // went up to 5, not yet picked up again
  EXPECT_DOUBLE_EQ(first_value(with_past(law, volts({0, 5, -3, 0}))), -1);  // down to -2, up again by 1
}

TEST(Past, OfARateIndependentLawIsTheWayThatASimulationTakes) {
  NumberList past;
  for (const double v : {0.0, 8.0, -5.0, 2.0}) past.push_back({v, "V"});
  const double walked = first_value(with_past(thesis_bouc_wen("u"), past));
  const auto p = compiled(diagram({{"y", thesis_bouc_wen("u")}}, {"y"}, {{"u", "V"}}));
  auto run = start(*p);
  bind_input(*p, run, "u", series({0, 1, 2, 3}, {0, 8, -5, 2}));
  const auto way = simulate(*p, run, {.instants = {0, 3}, .method = Method::adams, .relative_tolerance = 1e-10});
  // 400 steps of RK4 a way; where |z| has its kink inside one, its error is of the second order: (13 V/400)^2 of z''.
  EXPECT_NEAR(walked, trace(way).back(), 1e-7 * std::abs(walked));
}

TEST(Past, IsResetWithTheRunAndFollowsItsParameters) {
  NumberList past;
  for (const double v : {0.0, 5.0, 0.0}) past.push_back({v, "V"});
  const auto p = compiled(with_past(block("play", {{"radius", "1 V"}}, {"u"}), past));
  auto run = start(*p);
  set_parameter(*p, run, "y.radius", 2);
  reset(*p, run);
  EXPECT_DOUBLE_EQ(run.m[0], 2);  // up to 3, down to 0 + radius
}

TEST(Past, OfABlockThatForgetsIsAnErrorThatNamesThoseThatDoNot) {
  auto d = diagram({{"u", block("constant", {{"value", "1 V"}})},
                    {"y", block("play", {{"radius", "1 V"}}, {"u"})},
                    {"z", block("gain", {{"gain", 2.0}}, {"y"})}},
                   {"z"});
  d.simulate.past["z"] = {Number{1, "V"}};
  d.simulate.past["y"] = {Number{1, "m"}};
  try {
    compiled(d);
    FAIL();
  } catch (const Error& e) {
    ASSERT_EQ(e.problems.size(), 2U);
    EXPECT_EQ(e.problems[0].code, "no_memory");
    EXPECT_EQ(e.problems[0].path, "/simulate/past/z");
    EXPECT_NE(e.problems[0].cure.find("y"), std::string::npos);
    EXPECT_EQ(e.problems[1].code, "wrong_unit");
  }
}

TEST(Start, IsSteadyWhereTheDiagramSaysSo) {
  // x' = (2 u - x - y)/tau around a loop: in equilibrium x = u.
  auto d = diagram({{"u", block("constant", {{"value", "3 V"}})},
                    {"double", block("gain", {{"gain", 2.0}}, {"u"})},
                    {"e", block("sum", {{"signs", "+-"}}, {"double", "x"})},
                    {"x", block("lag", {{"times", list({0.1}, "s")}}, {"e"})}},
                   {"x"});
  d.simulate.start = "steady";
  const auto p = compiled(d);
  const auto traces = simulate(*p, start(*p), simulate_options(*p, {.until = 1}));
  for (const double x : trace(traces)) EXPECT_NEAR(x, 3, 1e-9);
  d.simulate.start = "stedy";
  const auto wrong = compiled(d);
  EXPECT_THROW(simulate_options(*wrong), Error);
}

}  // namespace
}  // namespace hysteron
