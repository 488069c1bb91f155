// Tables in diagrams: units of each axis, rows, fits, and knots that no step passes over.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/diagram/error.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using tools::block;

NumberMatrix rows(const std::vector<std::vector<double>>& numbers, const std::string& unit) {
  NumberMatrix m;
  for (const auto& row : numbers) {
    m.rows.emplace_back();
    for (const double n : row) m.rows.back().push_back({n, unit});
  }
  return m;
}
std::string table_problem(const Diagram& d) {
  try {
    tools::compiled(d);
  } catch (const Error& e) {
    std::string all;
    for (const auto& p : e.problems) all += p.what + "\n";
    return all;
  }
  return "none";
}

TEST(LookupBlock, HasAUnitForEachAxisAndOneForItsValues) {
  const auto d = tools::diagram({{"force", block("lookup",
                                                 {{"values", rows({{0, 0, 0}, {10, 8, 5}}, "N")},
                                                  {"at", tools::list({0, 2}, "A")},
                                                  {"at_2", tools::list({0, 5, 10}, "mm")}},
                                                 {"current", "position"})}},
                                {"force"}, {{"current", "A"}, {"position", "m"}});
  const auto program = tools::compiled(d);
  EXPECT_EQ(program->signals[static_cast<std::size_t>(program->signal("force"))].unit.text, "N");
  auto run = start(*program);
  run.series[0] = tools::series({0, 1}, {1, 1});
  run.series[1] = tools::series({0, 1}, {0.0025, 0.0075});
  SimulateOptions options;
  options.instants = {0, 1};
  options.until = 1;
  const auto y = tools::trace(simulate(*program, std::move(run), options));
  EXPECT_DOUBLE_EQ(y[0], 4.5);  // half way between 0 and 9
  EXPECT_DOUBLE_EQ(y[1], 3.25);
  ASSERT_NE(program->find_parameter("force.values[1][2]"), nullptr);
  EXPECT_TRUE(program->find_parameter("force.values[1][2]")->linear);
}

TEST(LookupBlock, OnlyTheValuesOfAStraightTableAreLinear) {
  for (const char* between : {"linear", "akima", "monotone"}) {
    const auto d = tools::diagram(
        {{"y",
          block("lookup", {{"values", tools::list({0, 1, 3})}, {"at", tools::list({0, 1, 2})}, {"between", between}},
                {"u"})}},
        {"y"}, {{"u", ""}});
    EXPECT_EQ(tools::compiled(d)->find_parameter("y.values[1]")->linear, std::string(between) == "linear") << between;
  }
}

TEST(LookupBlock, RefusesTablesThatDoNotFitTheirAxes) {
  const auto table = [](const tools::Parameters& p, const std::vector<std::string>& in) {
    std::vector<std::pair<std::string, std::string>> inputs;
    for (const auto& name : in) inputs.emplace_back(name, "");
    return table_problem(tools::diagram({{"y", block("lookup", p, in)}}, {"y"}, inputs));
  };
  EXPECT_NE(table({{"values", tools::list({1, 2, 3})}, {"at", tools::list({0, 1})}}, {"u"})
                .find("\"values\" has 3 numbers, the axes make 2"),
            std::string::npos);
  EXPECT_NE(
      table({{"values", tools::list({1, 2})}, {"at", tools::list({0, 1})}}, {"u", "v"}).find("2 wires for 1 axes"),
      std::string::npos);
  EXPECT_NE(table({{"values", tools::list({1})}, {"at", tools::list({0})}}, {"u"}).find("one knot"), std::string::npos);
  EXPECT_NE(table({{"values", tools::list({1, 2})}, {"at", tools::list({1, 0})}}, {"u"}).find("does not increase"),
            std::string::npos);
  EXPECT_NE(table({{"values", rows({{1, 2, 3}, {4, 5, 6}}, "V")},
                   {"at", tools::list({0, 1, 2})},
                   {"at_2", tools::list({0, 1})}},
                  {"u", "v"})
                .find("\"values\" has 2 rows of 3, the axes make 3 of 2"),
            std::string::npos);
}

/// The integral of a table over a sine: against a fine sum of straight pieces by hand.
TEST(LookupBlock, IsSteppedOverByNoIntegrator) {
  const std::vector<double> at{-0.9, -0.2, 0.95, 0.97, 0.99}, values{0, 1, 0, 30, 0};
  const auto d =
      tools::diagram({{"u", block("sine", {{"amplitude", 1.0}, {"frequency", "1 Hz"}})},
                      {"y", block("lookup", {{"values", tools::list(values)}, {"at", tools::list(at)}}, {"u"})},
                      {"i", block("integrator", {}, {"y"})}},
                     {"i"});
  const auto by_hand = [&](double u) {
    if (u <= at.front()) return values.front();
    for (std::size_t k = 1; k < at.size(); ++k)
      if (u < at[k]) return values[k - 1] + (values[k] - values[k - 1]) * (u - at[k - 1]) / (at[k] - at[k - 1]);
    return values.back();
  };
  double right = 0;
  constexpr int n = 2'000'000;
  for (int k = 0; k < n; ++k) right += by_hand(std::sin(2 * M_PI * (k + 0.5) / n)) / n;
  for (const Method method : {Method::bdf, Method::runge_kutta}) {
    const auto program = tools::compiled(d);
    SimulateOptions options;
    options.until = 3;
    options.method = method;
    EXPECT_NEAR(tools::trace(simulate(*program, start(*program), options)).back(), 3 * right, 3e-5)
        << method_name(method);
  }
}

TEST(LookupBlock, EndsTheRunOutsideWhereAsked) {
  const auto d = tools::diagram(
      {{"u", block("sine", {{"amplitude", 2.0}, {"frequency", "1 Hz"}})},
       {"y",
        block("lookup", {{"values", tools::list({0, 1})}, {"at", tools::list({-1, 1})}, {"outside", "refuse"}}, {"u"})},
       {"i", block("integrator", {}, {"y"})}},
      {"i"});
  const auto program = tools::compiled(d);
  SimulateOptions options;
  options.until = 1;
  try {
    simulate(*program, start(*program), options);
    FAIL() << "it went on";
  } catch (const Error& e) {
    const std::string told = e.what();
    EXPECT_NE(told.find("lookup"), std::string::npos) << told;
    // the cure, and nothing of files and fits
    EXPECT_NE(told.find("give further knots, or \"outside\": \"clip\""), std::string::npos) << told;
    EXPECT_EQ(told.find("From a file"), std::string::npos) << told;
  }
}

}  // namespace
}  // namespace hysteron
