// The blocks with vector ports in whole diagrams: closed forms, units, and the exact advance.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/diagram/error.h"
#include "engine/simulate/simulate.h"
#include "tests/blocks/bench.h"

namespace hysteron {
namespace {

Node node(const std::string& type, std::vector<std::pair<std::string, Value>> values,
          std::vector<std::string> in = {}) {
  Node n;
  n.type = type;
  for (auto& [name, value] : values) n.parameters[name] = value;
  for (auto& from : in) n.in.push_back({"", from});
  return n;
}
Value matrix(std::vector<std::vector<double>> rows, const std::string& unit = "") {
  NumberMatrix m;
  for (const auto& row : rows) {
    m.rows.emplace_back();
    for (const double v : row) m.rows.back().push_back(unit.empty() ? Number{v, {}} : Number{v, unit});
  }
  return Value(std::move(m));
}
/// A recorded signal that stays at one value: the exact advance takes it.
Node held_at(double value) {
  return node("recorded",
              {{"samples", Value(std::make_shared<const Series>(Series{{0, 2}, {value, value}, Between::linear}))}});
}
Traces simulated(const Diagram& d, const std::vector<std::string>& signals, Method method, double tolerance = 1e-9) {
  const auto program = compile(d, bench::registry());
  SimulateOptions options;
  for (int k = 0; k <= 40; ++k) options.instants.push_back(k / 40.0);
  options.until = 1;
  options.method = method;
  options.relative_tolerance = tolerance;
  for (const auto& s : signals) options.signals.push_back(program->signal(s));
  return simulate(*program, start(*program), options);
}

TEST(StateSpaceBlock, AnUndampedOscillatorAnswersAStepByItsClosedForm) {
  // x1'' = w^2 (u - x1): x1 = u (1 - cos wt), x2 = u w sin wt
  const double w = 7, u = 2;
  Diagram d;
  d.blocks["u"] = held_at(u);
  d.blocks["y"] = node(
      "state_space",
      {{"a", matrix({{0, 1}, {-w * w, 0}})}, {"b", matrix({{0}, {w * w}})}, {"c", matrix({{1, 0}, {0, 1}})}}, {"u"});
  for (const Method method : {Method::exact, Method::bdf}) {
    const Traces y = simulated(d, {"y[0]", "y[1]"}, method, 1e-10);
    // exact: rounding of the matrix exponential over 40 rows; bdf: 1e-10 per step over about 1000 steps, times w
    const double tolerance = method == Method::exact ? 1e-11 : 1e-5;
    for (std::size_t k = 0; k < y.t.size(); ++k) {
      EXPECT_NEAR(y.values[0][k], u * (1 - std::cos(w * y.t[k])), tolerance) << y.t[k];
      EXPECT_NEAR(y.values[1][k], u * w * std::sin(w * y.t[k]), w * tolerance) << y.t[k];
    }
  }
}

TEST(StateSpaceBlock, IsTheTransferFunctionOfItsMatrices) {
  // (s + 3)/(s^2 + 2 s + 8) in companion form, and 0.5 + that
  Diagram d;
  d.blocks["u"] = held_at(1.5);
  const Value a = matrix({{0, 1}, {-8, -2}}), b = matrix({{0}, {1}}), c = matrix({{3, 1}});
  d.blocks["strict"] = node("state_space", {{"a", a}, {"b", b}, {"c", c}}, {"u"});
  d.blocks["direct"] = node("state_space", {{"a", a}, {"b", b}, {"c", c}, {"d", matrix({{0.5}})}}, {"u"});
  const auto list = [](std::vector<double> v) {
    NumberList numbers;
    for (const double x : v) numbers.push_back({x, {}});
    return Value(std::move(numbers));
  };
  d.blocks["expected"] = node("transfer_function", {{"num", list({1, 3})}, {"den", list({1, 2, 8})}}, {"u"});
  d.record = {"strict", "direct", "expected"};
  const Traces y = simulated(d, d.record, Method::exact);
  for (std::size_t k = 0; k < y.t.size(); ++k) {
    EXPECT_NEAR(y.values[0][k], y.values[2][k], 1e-12) << y.t[k];  // rounding of two matrix exponentials
    EXPECT_NEAR(y.values[1][k], y.values[2][k] + 0.75, 1e-12) << y.t[k];
  }
}

TEST(StateSpaceBlock, TheMatricesCountInTheUnitsThatItNames) {
  Diagram d;
  d.blocks["a"] = node("constant", {{"value", "2 mV"}});
  d.blocks["b"] = node("constant", {{"value", "3 A"}});
  d.blocks["u"] = node("mux", {}, {"a", "b"});
  d.blocks["y"] = node("state_space",
                       {{"a", matrix({{-1}})},
                        {"b", matrix({{1, 0}})},
                        {"c", matrix({{1}, {0}})},
                        {"d", matrix({{5, 0}, {0, 7}})},
                        {"initial", NumberList{{4, {}}}},
                        {"input_unit", "mV, A"},
                        {"output_unit", "um, degC"}},
                       {"u"});
  d.record = {"y"};
  const auto program = compile(d, bench::registry());
  const hysteron::Run run = start(*program);
  Work work(*program);
  evaluate_values(*program, run, work, 0, run.x.data());
  const auto s0 = static_cast<std::size_t>(program->signal("y[0]")),
             s1 = static_cast<std::size_t>(program->signal("y[1]"));
  EXPECT_NEAR(work.y[s0], (4 + 5 * 2) * 1e-6, 1e-20);  // rounding of two conversions
  EXPECT_NEAR(work.y[s1], 7 * 3 + 273.15, 1e-12);
  EXPECT_EQ(program->signals[s0].unit.text, "um");
  EXPECT_EQ(program->signals[s1].unit.text, "degC");
}

TEST(StateSpaceBlock, WithoutADirectPathItClosesALoop) {
  // x' = -x + (r - x): x = r/2 (1 - e^(-2t))
  Diagram d;
  d.blocks["r"] = held_at(3);
  d.blocks["error"] = node("sum", {{"signs", "+-"}}, {"r", "y"});
  d.blocks["y"] = node("state_space", {{"a", matrix({{-1}})}, {"b", matrix({{1}})}, {"c", matrix({{1}})}}, {"error"});
  const Traces y = simulated(d, {"y"}, Method::exact);
  for (std::size_t k = 0; k < y.t.size(); ++k)
    EXPECT_NEAR(y.values[0][k], 1.5 * (1 - std::exp(-2 * y.t[k])), 1e-12) << y.t[k];  // rounding over 40 rows
}

TEST(StateSpaceBlock, AnElementOfItsMatrixIsAParameterOfARun) {
  Diagram d;
  d.blocks["r"] = held_at(3);
  d.blocks["y"] = node("state_space",
                       {{"a", matrix({{0, 1}, {-4, 0}})},
                        {"b", matrix({{0}, {0}})},
                        {"c", matrix({{1, 0}})},
                        {"initial", NumberList{{1, {}}, {0, {}}}}},
                       {"r"});
  const auto program = compile(d, bench::registry());
  hysteron::Run run = start(*program);
  set_parameter(*program, run, "y.a[1][0]", -9);  // from cos 2t to cos 3t
  SimulateOptions options;
  options.instants = {0, 0.5, 1};
  options.until = 1;
  options.method = Method::exact;
  options.signals = {program->signal("y")};
  const Traces y = simulate(*program, run, options);
  EXPECT_NEAR(y.values[0][2], std::cos(3.0), 1e-12);
}

TEST(VectorBlocks, CoupledIntegratorsRelaxAlongTheEigenvectorsOfTheirMatrix) {
  // x' = u - K x, K = [[2, 1], [1, 2]]: eigenvalue 3 along (1, 1), eigenvalue 1 along (1, -1). With u = (1, 0):
  // x = ((1 - e^-3t)/6 + (1 - e^-t)/2, (1 - e^-3t)/6 - (1 - e^-t)/2)
  Diagram d;
  d.blocks["on"] = held_at(1);
  d.blocks["off"] = held_at(0);
  d.blocks["u"] = node("mux", {}, {"on", "off"});
  d.blocks["rate"] = node("sum", {{"signs", "+-"}}, {"u", "back"});
  d.blocks["x"] = node("integrator", {}, {"rate"});
  d.blocks["back"] = node("matrix_gain", {{"matrix", matrix({{2, 1}, {1, 2}}, "1/s")}}, {"x"});
  for (const Method method : {Method::exact, Method::bdf}) {
    const Traces y = simulated(d, {"x[0]", "x[1]"}, method);
    for (std::size_t k = 0; k < y.t.size(); ++k) {
      const double fast = (1 - std::exp(-3 * y.t[k])) / 6, slow = (1 - std::exp(-y.t[k])) / 2;
      const double tolerance = method == Method::exact ? 1e-12 : 1e-7;  // rounding; 100 rtol
      EXPECT_NEAR(y.values[0][k], fast + slow, tolerance) << y.t[k];
      EXPECT_NEAR(y.values[1][k], fast - slow, tolerance) << y.t[k];
    }
  }
}

}  // namespace
}  // namespace hysteron
