// Blocks in whole diagrams: units are found, and the simulated response is the closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/diagram/error.h"
#include "engine/simulate/simulate.h"
#include "tests/blocks/bench.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using tools::grid;
Node node(const std::string& type, std::vector<std::pair<std::string, Value>> values,
          std::vector<std::string> in = {}) {
  Node n;
  n.type = type;
  for (auto& [name, value] : values) n.parameters[name] = value;
  for (auto& from : in) n.in.push_back({"", from});
  return n;
}
Value series(std::vector<double> t, std::vector<double> v, Between between = Between::linear) {
  return Value(std::make_shared<const Series>(Series{std::move(t), std::move(v), between}));
}
NumberList numbers(std::vector<double> values, const std::string& unit = "") {
  NumberList list;
  for (const double v : values) list.push_back(unit.empty() ? Number{v, {}} : Number{v, unit});
  return list;
}

/// Times and values of signal "y" of a diagram [SI].
Traces simulated(const Diagram& d, std::vector<double> instants, Method method, double tolerance = 1e-9) {
  const auto program = compile(d, bench::registry());
  SimulateOptions options;
  options.instants = std::move(instants);
  options.until = options.instants.back();
  options.method = method;
  options.relative_tolerance = tolerance;
  options.signals = {program->signal("y")};
  return simulate(*program, start(*program), options);
}
TEST(BlocksInDiagrams, UnitsOfEveryTypeFitTogetherInOneChain) {
  Diagram d;
  d.blocks["u"] = node("sine", {{"amplitude", "3 V"}, {"offset", "3 V"}, {"frequency", "5 Hz"}, {"phase", "-90 deg"}});
  d.blocks["amplifier"] = node("lag", {{"times", numbers({0.1}, "ms")}}, {"u"});
  d.blocks["limited"] = node("saturation", {{"lower", "-20 V"}, {"upper", "inf V"}}, {"amplifier"});
  d.blocks["core"] =
      node("prandtl_ishlinskii", {{"thresholds", numbers({0, 1}, "V")}, {"weights", numbers({0.7, 0.2}, "um/V")}},
           {"limited"});
  d.blocks["creep"] = node("creep", {{"amounts", numbers({0.01, 0.01})}, {"times", numbers({0.3, 3}, "s")}}, {"core"});
  d.blocks["mechanics"] =
      node("transfer_function", {{"num", numbers({1})}, {"den", numbers({1e-8, 1e-4, 1})}}, {"creep"});
  d.blocks["other"] = node(
      "bouc_wen", {{"alpha", "0.6187 um/V"}, {"beta", "0.2418 1/V"}, {"gamma", "0.0237 1/V"}, {"d_p", "1.6126 um/V"}},
      {"limited"});
  d.blocks["both"] = node("sum", {{"signs", "+-"}}, {"mechanics", "other"});
  d.blocks["later"] = node("dead_time", {{"delay", "1 ms"}}, {"both"});
  d.blocks["shown"] = node("calibration", {{"offset", "1 um"}}, {"later"});
  d.blocks["y"] = node("sensor_noise", {{"rms", "1 nm"}, {"period", "0.1 ms"}}, {"shown"});
  d.blocks["controller"] = node("pi_controller", {{"kp", "1.207 V/um"}, {"ki", "7009 V/(um s)"}}, {"y"});
  d.blocks["sum_of_u"] = node("integrator", {}, {"u"});
  d.blocks["power"] = node("product", {}, {"u", "controller"});
  d.outputs["y"] = "y";
  d.record = {"controller", "sum_of_u", "power"};
  const auto program = compile(d, bench::registry());
  const auto dimension = [&](const std::string& s) {
    return program->signals[static_cast<std::size_t>(program->signal(s))].dimension;
  };
  EXPECT_EQ(dimension("y"), parse_unit("um").dimension);
  EXPECT_EQ(dimension("mechanics"), parse_unit("um").dimension);
  EXPECT_EQ(dimension("controller"), parse_unit("V").dimension);
  EXPECT_EQ(dimension("sum_of_u"), parse_unit("V s").dimension);
  EXPECT_EQ(dimension("power"), parse_unit("V V").dimension);
  EXPECT_TRUE(std::isfinite(simulated(d, grid(0, 0.05, 20), Method::bdf, 1e-6).values[0].back()));
}

TEST(BlocksInDiagrams, ATwoPoleLagAnswersAStepByItsClosedForm) {
  // y = 1 - (t1 e^(-t/t1) - t2 e^(-t/t2))/(t1 - t2)
  Diagram d;
  d.blocks["u"] = node("recorded", {{"samples", series({0, 1}, {1, 1})}});
  d.blocks["y"] = node("lag", {{"times", numbers({0.1, 0.3})}}, {"u"});
  for (const Method method : {Method::exact, Method::bdf}) {
    const Traces traces = simulated(d, grid(0, 1, 20), method);
    for (std::size_t k = 0; k < traces.t.size(); ++k) {
      const double t = traces.t[k];
      const double expected = 1 - (0.1 * std::exp(-t / 0.1) - 0.3 * std::exp(-t / 0.3)) / (0.1 - 0.3);
      EXPECT_NEAR(traces.values[0][k], expected, method == Method::exact ? 1e-13 : 1e-7) << t;  // 100 rtol
    }
  }
}

TEST(BlocksInDiagrams, CreepAnswersAStepByItsClosedForm) {
  Diagram d;
  d.blocks["u"] = node("recorded", {{"samples", series({0, 1}, {2, 2})}});
  d.blocks["y"] = node("creep", {{"amounts", numbers({0.1, 0.2})}, {"times", numbers({0.1, 3})}}, {"u"});
  const Traces traces = simulated(d, grid(0, 1, 20), Method::bdf);
  for (std::size_t k = 0; k < traces.t.size(); ++k) {
    const double t = traces.t[k];
    EXPECT_NEAR(traces.values[0][k], 2 * (1 + 0.1 * (1 - std::exp(-t / 0.1)) + 0.2 * (1 - std::exp(-t / 3))), 2e-7)
        << t;
  }
}

TEST(BlocksInDiagrams, ADeadTimeBehindARecordingIsTheRecordingLater) {
  // Straight lines with corners: whatever the steps, a corner must stay sharp behind the delay.
  Diagram d;
  const std::vector<double> t{0, 0.1, 0.23, 0.5, 1}, v{0, 2, -1, 3, 0};
  d.blocks["u"] = node("recorded", {{"samples", series(t, v)}});
  d.blocks["y"] = node("dead_time", {{"delay", "0.07 s"}}, {"u"});
  const Series expected{t, v, Between::linear};
  for (const Method method : {Method::exact, Method::bdf}) {
    const Traces traces = simulated(d, grid(0, 1, 200), method);
    for (std::size_t k = 0; k < traces.t.size(); ++k) {
      const double late = traces.t[k] - 0.07;
      EXPECT_NEAR(traces.values[0][k], expected.value(late, late), 1e-12)
          << "at " << traces.t[k] << (method == Method::exact ? " exact" : " bdf");
    }
  }
}

TEST(BlocksInDiagrams, ADeadTimeBehindASineIsTheSineLater) {
  Diagram d;
  d.blocks["u"] = node("sine", {{"amplitude", "2 V"}, {"frequency", "1 Hz"}});
  d.blocks["y"] = node("dead_time", {{"delay", "0.13 s"}}, {"u"});
  const Traces traces = simulated(d, grid(0, 2, 100), Method::bdf, 1e-8);
  for (std::size_t k = 0; k < traces.t.size(); ++k) {
    const double late = traces.t[k] - 0.13;
    // cubic Hermite over steps of at most the delay: 2 (2 pi)^4 h^4/384 = 2.3e-3 at worst, at h = 0.13 s
    EXPECT_NEAR(traces.values[0][k], late < 0 ? 0 : 2 * std::sin(2 * M_PI * late), 2.4e-3) << traces.t[k];
  }
}

TEST(BlocksInDiagrams, AnOperatorBehindARecordingStartsWhereItsPastLeftIt) {
  // One-sided, threshold 1, visited -1 V before: w(0) = max(0 - 1, min(0, -1)) = -1; at 2 V it is 1.
  Diagram d;
  d.blocks["u"] = node("recorded", {{"samples", series({0, 1}, {0, 2})}});
  d.blocks["y"] = node("play", {{"radius", 1.0}, {"sides", "one"}, {"before", -1.0}}, {"u"});
  for (const Method method : {Method::exact, Method::bdf}) {
    const Traces traces = simulated(d, {0, 0.25, 1}, method);
    EXPECT_NEAR(traces.values[0][0], -1, 1e-12);
    EXPECT_NEAR(traces.values[0][1], -0.5, 1e-12);
    EXPECT_NEAR(traces.values[0][2], 1, 1e-12);
  }
}

TEST(BlocksInDiagrams, NoiseIsTheSameWhateverTheSolver) {
  Diagram d;
  d.blocks["u"] = node("sine", {{"amplitude", "1 V"}, {"frequency", "1 Hz"}});
  d.blocks["y"] = node("sensor_noise", {{"rms", "1 V"}, {"period", "10 ms"}, {"seed", 5.0}}, {"u"});
  std::vector<double> instants;
  for (int k = 0; k < 100; ++k) instants.push_back(0.01 * k + 0.003);
  const auto bdf = simulated(d, instants, Method::bdf), adams = simulated(d, instants, Method::adams);
  bench::Bench b("sensor_noise", {{"rms", {1}}, {"period", {0.01}}, {"seed", {5}}});
  const auto program = compile(d, bench::registry());
  b.key = program->blocks[static_cast<std::size_t>(program->block_index("y"))].key;
  for (std::size_t k = 0; k < instants.size(); ++k) {
    EXPECT_EQ(bdf.values[0][k], adams.values[0][k]);
    EXPECT_NEAR(bdf.values[0][k], b.output(instants[k], {std::sin(2 * M_PI * instants[k])})[0], 1e-12);
  }
}

TEST(BlocksInDiagrams, RefusedValuesNameTheBlockAndTheCure) {
  Diagram d;
  d.blocks["u"] = node("sine", {{"amplitude", "1 V"}, {"frequency", "1 Hz"}});
  d.blocks["y"] = node("saturation", {{"lower", "2 V"}, {"upper", "1 V"}}, {"u"});
  try {
    compile(d, bench::registry());
    FAIL() << "not refused";
  } catch (const Error& e) {
    ASSERT_EQ(e.problems.size(), 1u);
    EXPECT_EQ(e.problems[0].code, "bad_value");
    EXPECT_EQ(e.problems[0].path, "/blocks/y");
    EXPECT_NE(e.problems[0].what.find("exchange them"), std::string::npos);
    EXPECT_FALSE(e.problems[0].cure.empty());
  }
}

}  // namespace
}  // namespace hysteron
