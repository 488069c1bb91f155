// Laws that a diagram writes itself: names, units, slopes, fitted parameters, and what they do in a simulation.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/diagram/error.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using tools::block;

Diagram written(const std::string& y, const tools::Parameters& parameters, const std::string& unit = "V") {
  auto values = parameters;
  values.emplace_back("y", y);
  return tools::diagram({{"law", block("expression", values, {"u"})}}, {"law"}, {{"u", unit}});
}

std::string expression_problem(const Diagram& d) {
  try {
    tools::compiled(d);
  } catch (const Error& e) {
    std::string all;
    for (const auto& p : e.problems) all += p.path + ": " + p.what + "; " + p.cure + "\n";
    return all;
  }
  return "none";
}
std::string unit_of_law(const Diagram& d) {
  const auto program = tools::compiled(d);
  return to_text(program->signals[static_cast<std::size_t>(program->signal("law"))].dimension);
}

/// What the diagram gives for a recorded input, from row to row.
std::vector<double> response(const Diagram& d, const std::vector<double>& u) {
  const auto program = tools::compiled(d);
  auto run = start(*program);
  run.series[0] = tools::series(tools::grid(0, 1, static_cast<int>(u.size()) - 1), u);
  SimulateOptions options;
  options.instants = run.series[0]->t;
  options.until = 1;
  return tools::trace(simulate(*program, std::move(run), options));
}

TEST(ExpressionBlock, TakesItsNamesFromTheText) {
  const auto d = written("a*sin(b*u) + max(c*u, 0)", {{"a", "2 um"}, {"b", "3 rad/V"}, {"c", "1 um/V"}});
  const std::vector<double> u{-1, -0.2, 0, 0.4, 1.7};
  const auto y = response(d, u);
  for (std::size_t i = 0; i < u.size(); ++i)  // a few roundings
    EXPECT_NEAR(y[i], 2e-6 * std::sin(3 * u[i]) + std::max(1e-6 * u[i], 0.0), 1e-20) << i;
  const auto program = tools::compiled(d);
  ASSERT_NE(program->find_parameter("law.a"), nullptr);
  EXPECT_TRUE(program->find_parameter("law.a")->linear);
  EXPECT_FALSE(program->find_parameter("law.b")->linear);
  EXPECT_FALSE(program->find_parameter("law.c")->linear);
  EXPECT_EQ(program->find_parameter("law.b")->unit.text, "rad/V");
}

TEST(ExpressionBlock, PortsAreNamedOrInTheOrderOfTheText) {
  Node node = block("expression", {{"y", "first - 2*second"}});
  node.in = {{"second", "b"}, {"first", "a"}};
  const auto d = tools::diagram({{"law", node}, {"other", block("expression", {{"y", "q - 2*r"}}, {"a", "b"})}},
                                {"law", "other"}, {{"a", "V"}, {"b", "V"}});
  const auto program = tools::compiled(d);
  auto run = start(*program);
  run.series[0] = tools::series({0, 1}, {3, 3});
  run.series[1] = tools::series({0, 1}, {10, 10});
  SimulateOptions options;
  options.instants = {0, 1};
  options.until = 1;
  const auto traces = simulate(*program, std::move(run), options);
  EXPECT_DOUBLE_EQ(tools::trace(traces, 0)[1], -17);
  EXPECT_DOUBLE_EQ(tools::trace(traces, 1)[1], -17);
}

TEST(ExpressionBlock, FindsTheUnitOfItsValue) {
  EXPECT_EQ(unit_of_law(written("a*sin(b*u)", {{"a", "2 um"}, {"b", "3 rad/V"}})), "m");
  EXPECT_EQ(unit_of_law(written("sqrt(u^2 + a^2)", {{"a", "1 V"}}, "V")), to_text(parse_unit("V").dimension));
  EXPECT_EQ(unit_of_law(written("sqrt(u)", {}, "m^2")), "m");
  EXPECT_EQ(unit_of_law(written("u/a", {{"a", "1 V"}}, "V")), "1");
  EXPECT_EQ(unit_of_law(written("u > 1*a", {{"a", "1 V"}}, "V")), "1");
  EXPECT_EQ(unit_of_law(written("max(u, 0)", {}, "um")), "m");
  EXPECT_EQ(unit_of_law(written("asin(u)", {}, "")), to_text(parse_unit("rad").dimension));
  EXPECT_EQ(unit_of_law(written("u + 0.1*sin(u)", {}, "rad")), to_text(parse_unit("rad").dimension));
}

TEST(ExpressionBlock, AsksForUnitsThatNothingElseSays) {
  // x' = (a - x)/tau in a loop: that x is in um is said by a alone
  const auto d =
      tools::diagram({{"rate", block("expression", {{"y", "(a - x)/tau"}, {"a", "2 um"}, {"tau", "0.1 s"}}, {"x"})},
                      {"x", block("integrator", {}, {"rate"})}},
                     {"x"});
  const auto program = tools::compiled(d);
  EXPECT_EQ(to_text(program->signals[static_cast<std::size_t>(program->signal("x"))].dimension), "m");
  SimulateOptions options;
  options.until = 0.1;
  const auto x = tools::trace(simulate(*program, start(*program), options));
  EXPECT_NEAR(x.back(), 2e-6 * (1 - std::exp(-1)), 2e-11);  // ten times the relative tolerance
}

TEST(ExpressionBlock, TellsWhichUnitsDoNotFitAndWhere) {
  EXPECT_EQ(expression_problem(written("u + a", {{"a", "2 um"}})).substr(0, 60),
            "/blocks/law/y: \"law\": cannot add V and um at character 3; mu");
  EXPECT_NE(expression_problem(written("2*u + sin(u)", {}))
                .find("the argument of sin is in V, expected a plain number or an angle at character 7"),
            std::string::npos);
  EXPECT_NE(expression_problem(written("sin(u)", {}, "Hz s")).find("cycles"), std::string::npos);
  EXPECT_NE(expression_problem(written("u^a", {{"a", 2}})).find("the exponent of V is no number at character 2"),
            std::string::npos);
  EXPECT_NE(expression_problem(written("u > a", {{"a", "2 um"}})).find("cannot compare um and V at character 3"),
            std::string::npos);
  EXPECT_NE(expression_problem(written("u + 1", {})).find("cannot add V and a plain number at character 3"),
            std::string::npos);
  EXPECT_NE(expression_problem(written("sqrt(u)", {})).find("the result has the unit V^(1/2)"), std::string::npos);
  EXPECT_NE(expression_problem(written("u", {{"unit", "um"}})).find("the expression gives V"), std::string::npos);
  EXPECT_NE(expression_problem(written("u", {{"unit", "furlongz"}})).find("/blocks/law/unit: "), std::string::npos);
  EXPECT_EQ(expression_problem(written("u*0 + 0", {})), "none");
}

TEST(ExpressionBlock, TellsWhatIsWrongWithItsText) {
  EXPECT_NE(expression_problem(written("2*(u", {}))
                .find("/blocks/law/y: \"y\": the parenthesis is not closed that opens at character 3"),
            std::string::npos);
  EXPECT_NE(expression_problem(written("", {})).find("there is no expression"), std::string::npos);
  EXPECT_NE(
      expression_problem(written("a*u", {{"a", 1}, {"aa", 2}})).find("/blocks/law/aa: the expression has no \"aa\""),
      std::string::npos);
  EXPECT_NE(expression_problem(written("a*u", {})).find("input \"u\" of expression \"law\" is not connected"),
            std::string::npos);
  EXPECT_NE(expression_problem(written("a*u", {})).find("give the block a value for it"), std::string::npos);
  EXPECT_NE(expression_problem(written("a*u", {{"a", Value("drive")}})).find("under \"in\": {\"a\": ...}"),
            std::string::npos)
      << "a wire that was written as a value";
}

TEST(ExpressionBlock, ATextThatBeginsWithANumberIsOne) {
  for (const char* y : {"2*u", "2 * u", "2/(1/u)", "3-1*u", "1e0*u"}) {
    EXPECT_EQ(expression_problem(written(y, {}, "")), "none") << y;
  }
  EXPECT_DOUBLE_EQ(response(written("2/(1/u)", {}, ""), {3, 3})[0], 6);
}

TEST(ExpressionBlock, WorksOnVectorsElementByElement) {
  auto d = tools::diagram({{"law", block("expression", {{"y", "a*u^2"}, {"a", 3}}, {"u"})}}, {"law"}, {{"u", ""}});
  d.inputs.find("u")->length = 2;
  const auto program = tools::compiled(d);
  auto run = start(*program);
  run.series[0] = tools::series({0, 1}, {2, 2});
  run.series[1] = tools::series({0, 1}, {5, 5});
  SimulateOptions options;
  options.instants = {0, 1};
  options.until = 1;
  const auto traces = simulate(*program, std::move(run), options);
  EXPECT_DOUBLE_EQ(tools::trace(traces, 0)[1], 12);
  EXPECT_DOUBLE_EQ(tools::trace(traces, 1)[1], 75);
}

TEST(ExpressionBlock, IsSteppedOverByNoIntegrator) {
  // sin(2 pi t) is above 0.99 for a part of 0.045 of each turn: two jumps per turn, integrated over ten turns.
  const auto d =
      tools::diagram({{"s", block("sine", {{"amplitude", 1.0}, {"frequency", "1 Hz"}})},
                      {"law", block("expression", {{"y", "if(s > 0.99, 1, 0) + abs(s) + max(s, -0.5)"}}, {"s"})},
                      {"i", block("integrator", {}, {"law"})}},
                     {"i"});
  const double above = 0.5 - std::asin(0.99) / M_PI;  // of a turn
  // over a turn |sin| has the mean 2/pi; max(sin, -1/2) that of what it cuts off: (2 cos(a) - (pi - 2 a)/2)/(2 pi)
  const double a = std::asin(0.5), cut = (2 * std::cos(a) - 0.5 * (M_PI - 2 * a)) / (2 * M_PI);
  for (const Method method : {Method::bdf, Method::adams, Method::runge_kutta}) {
    const auto program = tools::compiled(d);
    SimulateOptions options;
    options.until = 10;
    options.method = method;
    const auto y = tools::trace(simulate(*program, start(*program), options));
    EXPECT_NEAR(y.back(), 10 * (above + 2 / M_PI + cut), 1e-4) << method_name(method);  // ten times 1e-6 of the value
  }
}

TEST(ExpressionBlock, HandsItsRateToLawsThatWantIt) {
  // Bouc-Wen behind 2 u^2 - 1 against Bouc-Wen behind the same signal in closed form: cos(2 w t) = 2 cos(w t)^2 - 1
  const auto core = [](const std::string& in) {
    return block("bouc_wen", {{"alpha", 0.6}, {"beta", 0.24}, {"gamma", 0.02}, {"d_p", 1.6}}, {in});
  };
  const auto d =
      tools::diagram({{"c", block("sine", {{"amplitude", 1.0}, {"frequency", "1 Hz"}, {"phase", "90 deg"}})},
                      {"law", block("expression", {{"y", "2*c^2 - 1"}}, {"c"})},
                      {"twice", block("sine", {{"amplitude", 1.0}, {"frequency", "2 Hz"}, {"phase", "90 deg"}})},
                      {"one", core("law")},
                      {"other", core("twice")}},
                     {"one", "other"});
  const auto program = tools::compiled(d);
  SimulateOptions options;
  options.until = 2;
  options.every = 0.05;
  const auto traces = simulate(*program, start(*program), options);
  EXPECT_LT(tools::distance(tools::trace(traces, 0), tools::trace(traces, 1)), 2e-5);  // ten times the tolerance
}

}  // namespace
}  // namespace hysteron
