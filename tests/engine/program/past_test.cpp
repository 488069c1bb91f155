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

TEST(Past, OfAGuideIsGoneThroughFasterThanItsExcessLasts) {
  const auto guide =
      block("guide_friction",
            {{"level", "0.2 V"}, {"slip_distance", "0.3 V"}, {"excess", 0.5}, {"stribeck_velocity", "1 V/s"}}, {"u"});
  const double walked = first_value(with_past(guide, {{0, "V"}, {1, "V"}, {0.4, "V"}}));
  // y + level s = u along its own way: s = 1 - exp(-y/distance), and from there with -1 as its end.
  const auto way = [](double u, double from, double held, double end) {
    double low = from, high = u;
    for (int i = 0; i < 60; ++i) {
      const double y = (low + high) / 2;
      const double rest = y + 0.2 * (end + (held - end) * std::exp(-std::abs(y - from) / 0.3)) - u;
      (rest * end < 0 ? low : high) = y;
    }
    return low;
  };
  const double up = way(1, 0, 0, 1);
  EXPECT_NEAR(walked, way(0.4, up, (1 - up) / 0.2, -1), 1e-12);  // 400 steps of RK4 a way
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

// --- memory that is given

NumberList in_volts(const std::vector<double>& values) {
  NumberList list;
  for (const double v : values) list.push_back({v, "V"});
  return list;
}

/// w0_i = -share r_i: nested as SPEC 2.1 demands, 0 <= w_i - w_(i+1) <= r_(i+1) - r_i for 0 <= share <= 1.
std::vector<double> share_of_thresholds(double share) {
  std::vector<double> w;
  for (const double r : thesis_thresholds) w.push_back(r == 0 ? 0.0 : -share * r);
  return w;
}

TEST(GivenMemory, OfAPrandtlIshlinskiiModelGivesTheGoldenTraceAndItsInverse) {
  const auto trace_of = golden("pi_initial_state_sine");
  if (trace_of.empty()) GTEST_SKIP() << "no golden traces here";
  const auto& u = trace_of.at("u");
  auto inverse = thesis_operators("y");
  inverse.type = "prandtl_ishlinskii_inverse";
  auto d = diagram({{"y", thesis_operators("u")}, {"back", inverse}}, {"y", "back"}, {{"u", "V"}});
  for (const char* name : {"y", "back"}) d.simulate.memory[name] = in_volts(share_of_thresholds(0.3));
  const auto p = compiled(d);
  std::vector<double> t;
  for (std::size_t k = 0; k < u.size(); ++k) t.push_back(static_cast<double>(k) * 1e-4);
  for (const Method method : {Method::exact, Method::bdf}) {
    auto run = start(*p);
    bind_input(*p, run, "u", series(t, u));
    const auto traces = simulate(*p, run, {.instants = t, .method = method});
    for (std::size_t k = 0; k < u.size(); ++k) {
      // Ten digits of u (slope up to 1.42 um/V) and of y are written.
      ASSERT_NEAR(trace(traces, 0)[k] * 1e6, trace_of.at("y")[k], 1.3e-9) << k;
      ASSERT_NEAR(trace(traces, 1)[k], u[k], 1e-13) << k;
    }
  }
}

TEST(GivenMemory, LeavesTheRemanenceOfTheClosedForm) {
  // After the first full cycle 0 -> 6 V -> 0: y(T) - y(0) = -sum c_i w0_i (SPEC 2.1).
  const double share = 0.4;
  auto d = diagram({{"y", thesis_operators("u")}}, {"y"}, {{"u", "V"}});
  d.simulate.memory["y"] = in_volts(share_of_thresholds(share));
  const auto p = compiled(d);
  auto run = start(*p);
  bind_input(*p, run, "u", series({0, 1, 2}, {0, 6, 0}));
  const auto y = trace(simulate(*p, run, {.instants = {0, 1, 2}}));
  double expected = 0;
  for (std::size_t i = 0; i < thesis_weights.size(); ++i) expected += thesis_weights[i] * share * thesis_thresholds[i];
  EXPECT_NEAR((y[2] - y[0]) * 1e6, expected, 1e-14);
}

TEST(GivenMemory, IsWhatAPastWouldHaveLeft) {
  // Two-sided operators after 0 -> 5 V -> 1 V stand at max(5 - r, 0), then no more than r above 1 V.
  const auto law =
      block("prandtl_ishlinskii",
            {{"thresholds", list({0, 0.5, 1, 3}, "V")}, {"weights", list({1, 2, 3, 4})}, {"sides", "two"}}, {"u"});
  auto given = diagram({{"u", block("constant", {{"value", "1 V"}})}, {"y", law}}, {"y"});
  auto walked = given;
  given.simulate.memory["y"] = in_volts({1, 1.5, 2, 2});
  walked.simulate.past["y"] = in_volts({0, 5, 1});
  EXPECT_DOUBLE_EQ(first_value(given), 1 + 2 * 1.5 + 3 * 2 + 4 * 2);
  EXPECT_DOUBLE_EQ(first_value(given), first_value(walked));
}

TEST(GivenMemory, IsTakenByEveryBlockThatRemembers) {
  for (const auto& type : registry().types()) {
    if (type == "ageing") continue;  // it counts turns from the start; what was before is its input "used"
    const Kernel& kernel = *registry().find(type);
    EXPECT_EQ(kernel.advance != nullptr, !kernel.declaration.memory_port.empty()) << type;
  }
}

TEST(GivenMemory, IsWhereAPastBegins) {
  auto d =
      diagram({{"u", block("constant", {{"value", "2 V"}})}, {"y", block("play", {{"radius", "1 V"}}, {"u"})}}, {"y"});
  d.simulate.memory["y"] = in_volts({-7});
  d.simulate.past["y"] = in_volts({-7.5, -7});
  EXPECT_DOUBLE_EQ(start(*compiled(d)).m[0], -7);  // the way between stays inside the dead zone
}

TEST(GivenMemory, ThatNoInputCouldHaveLeftIsAnErrorThatNamesTheOperators) {
  auto d = diagram({{"u", block("constant", {{"value", "1 V"}})}, {"y", thesis_operators("u")}}, {"y"});
  auto memory = share_of_thresholds(0.3);
  memory[3] = 1;  // above its neighbour: one-sided operators of wider thresholds stand lower
  d.simulate.memory["y"] = in_volts(memory);
  try {
    compiled(d);
    FAIL();
  } catch (const Error& e) {
    ASSERT_EQ(e.problems.size(), 1U);
    EXPECT_EQ(e.problems[0].code, "bad_value");
    EXPECT_EQ(e.problems[0].path, "/simulate/memory/y");
    EXPECT_NE(e.problems[0].what.find("thresholds 1.2 V and 1.8 V"), std::string::npos) << e.problems[0].what;
    EXPECT_NE(e.problems[0].cure.find("past"), std::string::npos);
  }
}

TEST(GivenMemory, OfOtherLengthsUnitsOrBlocksIsAnErrorEach) {
  auto d = diagram({{"u", block("constant", {{"value", "1 V"}})},
                    {"y", thesis_operators("u")},
                    {"z", block("play", {{"radius", "1 V"}}, {"u"})},
                    {"lag", block("lag", {{"times", list({0.1}, "s")}}, {"u"})}},
                   {"y", "z", "lag"});
  d.simulate.memory["y"] = in_volts({0, 0});
  d.simulate.memory["z"] = {Number{1, "um"}};
  d.simulate.memory["lag"] = in_volts({1});
  d.simulate.memory["yy"] = in_volts({1});
  try {
    compiled(d);
    FAIL();
  } catch (const Error& e) {
    ASSERT_EQ(e.problems.size(), 4U);
    EXPECT_EQ(e.problems[0].code, "wrong_length");
    EXPECT_NE(e.problems[0].what.find("10 numbers: the output w_i of each operator; here are 2"), std::string::npos)
        << e.problems[0].what;
    EXPECT_EQ(e.problems[1].code, "wrong_unit");
    EXPECT_EQ(e.problems[2].code, "no_memory");
    EXPECT_NE(e.problems[2].cure.find("y, z"), std::string::npos) << e.problems[2].cure;
    EXPECT_EQ(e.problems[3].code, "unknown_block");
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
