// Laws in whole diagrams: compensators cancel their actuators, plants give their closed forms, whatever integrates
// them.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/diagram/error.h"
#include "models/hysteresis/jiles_atherton.h"
#include "tests/blocks/simulated_by_bdf.h"
#include "tests/models/golden.h"

namespace hysteron {
namespace {

using tools::block;
using tools::grid;
using tools::list;
using tools::simulated_by_bdf;

Node reference(const std::string& shape, const std::string& unit) {
  return block(shape,
               {{"amplitude", "3 " + unit}, {"offset", "3 " + unit}, {"frequency", "5 Hz"}, {"phase", "-90 deg"}});
}
// Thesis Tables 2.1, 2.2, 2.3.
tools::Parameters bouc_wen_table() {
  return {{"alpha", "0.6187 um/V"}, {"beta", "0.2418 1/V"}, {"gamma", "0.0237 1/V"}, {"d_p", "1.6126 um/V"}};
}
tools::Parameters jiles_atherton_table() {
  return {{"p_s", "55.9973 um"}, {"a", "48.5843 V"}, {"alpha", "0.2512 V/um"}, {"k", "3.8892 V"}, {"c", 0.6929}};
}
tools::Parameters prandtl_ishlinskii_table() {
  std::vector<double> r;
  for (int i = 0; i < 10; ++i) r.push_back(0.6 * i);
  return {{"thresholds", list(r, "V")},
          {"weights", list({0.7521, 0.1381, 0.0775, 0.0651, 0.0658, 0.0522, 0.0506, 0.0523, 0.0520, 0.1169}, "um/V")}};
}

TEST(LawsInDiagrams, JilesAthertonReproducesTheGoldenTraces) {
  for (const std::string shape : {"sine", "triangle"}) {
    HYSTERON_NEEDS_GOLDEN("ja_forward_" + shape);
    const auto trace = golden::read("ja_forward_" + shape);
    const auto d = tools::diagram(
        {{"u", reference(shape, "V")}, {"y", block("jiles_atherton", jiles_atherton_table(), {"u"})}}, {"y"});
    const Traces traces = simulated_by_bdf(d, trace.at("t [s]"), 1e-9);
    for (std::size_t k = 0; k < traces.t.size(); ++k)  // what the traces ask of an integrated law; 2.6e-7 is found
      ASSERT_NEAR(1e6 * traces.values[0][k], trace.at("P [um]")[k], 1e-6) << shape << " row " << k;
  }
}

TEST(LawsInDiagrams, NormalisedJilesAthertonAndItsInverseReproduceTheGoldenTrace) {
  // SPEC 4.1: scale = L_p/L_m = 1 um / 6.63472393757 um. Tolerance as above, in the smaller unit of y.
  HYSTERON_NEEDS_GOLDEN("ja_normalised_sine");
  const auto trace = golden::read("ja_normalised_sine");
  auto law = jiles_atherton_table();
  law.emplace_back("scale", 1 / 6.63472393757);
  Node wanted =
      block("sine", {{"amplitude", "0.45 um"}, {"offset", "0.45 um"}, {"frequency", "5 Hz"}, {"phase", "-90 deg"}});
  const auto d = tools::diagram({{"u", reference("sine", "V")},
                                 {"y", block("jiles_atherton", law, {"u"})},
                                 {"r", wanted},
                                 {"command", block("jiles_atherton_inverse", law, {"r"})}},
                                {"y", "r", "command"});
  const Traces traces = simulated_by_bdf(d, trace.at("t [s]"), 1e-9);
  for (std::size_t k = 0; k < traces.t.size(); ++k) {
    ASSERT_NEAR(1e6 * traces.values[0][k], trace.at("P_n [-]")[k], 1e-6) << "row " << k;
    ASSERT_NEAR(1e6 * traces.values[1][k], trace.at("yr_n [-]")[k], 1e-9) << "row " << k;
    ASSERT_NEAR(traces.values[2][k], trace.at("u=inverse(yr_n) [V]")[k], 1e-6) << "row " << k;
  }
}

// A steel of the COMSOL material library, under a triangle of 10 kA/m from rest.
Diagram steel_under_a_triangle(const std::string& curve) {
  tools::Parameters law{{"p_s", "1.6e6 A/m"}, {"a", "560 A/m"}, {"alpha", 7e-4}, {"k", "1200 A/m"}, {"c", 0.1}};
  law.emplace_back("anhysteretic", curve);
  return tools::diagram({{"h", block("triangle", {{"amplitude", "10 kA/m"}, {"frequency", "1 Hz"}})},
                         {"m", block("jiles_atherton", law, {"h"})}},
                        {"h", "m"});
}

TEST(LawsInDiagrams, APublishedSetFollowsTheLawWithLangevinsFunction) {
  const Traces traces = simulated_by_bdf(steel_under_a_triangle("langevin"), grid(0, 2.25, 450), 1e-8);
  const jiles_atherton::Params<double> law{
      .p_s = 1.6e6, .a = 560, .alpha = 7e-4, .k = 1200, .c = 0.1, .curve = jiles_atherton::Curve::langevin};
  double p = 0, from = 0;
  for (std::size_t k = 0; k < traces.t.size(); ++k) {  // corners of the triangle are rows
    p = jiles_atherton::polarisation_after(law, p, from, traces.values[0][k]);
    from = traces.values[0][k];
    ASSERT_NEAR(traces.values[1][k], p, 1e-5 * law.p_s) << "row " << k;  // a slope of 2000 times a tolerance of 1e-8
    ASSERT_LE(std::fabs(traces.values[1][k]), law.p_s);
  }
}

TEST(LawsInDiagrams, WhereTheLawEndsTheRunDoesAndSaysWhy) {
  const auto program = tools::compiled(steel_under_a_triangle("tanh"));
  for (const auto& [method, step] : {std::pair{Method::automatic, 0.0},
                                     {Method::bdf, 0.0},
                                     {Method::runge_kutta, 0.0},
                                     {Method::rk4, 1e-4},
                                     {Method::euler, 1e-4}}) {
    try {
      simulate(*program, start(*program), {.until = 2.25, .every = 1e-3, .method = method, .step = step});
      ADD_FAILURE() << method_name(method) << ": taken without a word";
    } catch (const Error& e) {
      const auto& p = e.problems.front();
      EXPECT_EQ(e.fault, Fault::numerics);
      EXPECT_EQ(p.path, "m") << p.what;
      // Upright at -813 A/m of the falling branch (Runge's method of 20 000 steps), 0.25 s + 0.5 s * 10813/20000.
      EXPECT_NE(p.what.find("t = 0.52"), std::string::npos) << p.what;
      EXPECT_NE(p.what.find("does not hold"), std::string::npos) << p.what;
      EXPECT_NE(p.cure.find("langevin"), std::string::npos) << p.cure;
    }
  }
}

TEST(LawsInDiagrams, AnInverseThatDoesNotExistEndsTheRunAndSaysSo) {
  // Behind a turn the actuator's slope is d_p - alpha - (beta - gamma) z, at z near alpha/(beta + gamma): 0.3 - 1 < 0.
  const auto d = tools::diagram(
      {{"r", block("triangle", {{"amplitude", "10 um"}, {"frequency", "1 Hz"}})},
       {"u", block("bouc_wen_inverse",
                   {{"alpha", "1 um/V"}, {"beta", "1 1/V"}, {"gamma", "0 1/V"}, {"d_p", "1.3 um/V"}}, {"r"})}},
      {"u"});
  const auto program = tools::compiled(d);
  try {
    simulate(*program, start(*program), {.until = 1, .every = 1e-3});
    ADD_FAILURE() << "taken without a word";
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().path, "u") << e.what();
    EXPECT_EQ(e.fault, Fault::numerics);
  }
}

TEST(LawsInDiagrams, SampledTapiInverseCancelsItsActuatorAtEveryTemperature) {
  // At the sampling instants the held command has just been applied: the actuator is where it was wanted, within
  // rounding of a few um.
  const tools::Parameters law{{"thresholds", list({0, 0.5, 1.5, 3, 5}, "V")},
                              {"weights", list({0.66, 0.08, 0.05, 0.03, 0.02}, "um/V")},
                              {"p_s", "3.76 V"},
                              {"t_c", "350 degC"},
                              {"beta", 0.5},
                              {"a", "0.01694 V/K"}};
  auto inverse = law;
  inverse.emplace_back("period", "1 ms");
  const auto d =
      tools::diagram({{"r", reference("sine", "um")},
                      {"hot", block("sine", {{"amplitude", "20 K"}, {"offset", "320 K"}, {"frequency", "1 Hz"}})},
                      {"u", block("sampled_tapi_inverse", inverse, {"r", "hot"})},
                      {"held", block("sample_hold", {{"period", "1 ms"}}, {"hot"})},
                      {"y", block("tapi", law, {"u", "held"})}},
                     {"r", "y", "u"});
  std::vector<double> instants;
  for (int k = 1; k < 400; ++k) instants.push_back(k * 1e-3 + 0.5e-3);
  const Traces traces = simulated_by_bdf(d, instants, 1e-9);
  double top = 0;
  for (std::size_t k = 0; k < traces.t.size(); ++k) {
    const double wanted = 3 - 3 * std::cos(2 * M_PI * 5 * (traces.t[k] - 0.5e-3));  // um, of the last instant
    ASSERT_NEAR(1e6 * traces.values[1][k], wanted, 1e-9) << "row " << k;
    top = std::fmax(top, traces.values[2][k]);
  }
  EXPECT_GT(top, 3);
}

struct Pair {
  const char* name;
  tools::Parameters (*parameters)();
  double tolerance;  ///< [um]
};
class Compensated : public testing::TestWithParam<Pair> {};
TEST_P(Compensated, ActuatorBehindItsInverseFollowsTheReference) {
  // Claims C2-02 and C2-06: H(H^-1(r)) = r within 1e-6 um (laws that are integrated), within rounding (operators).
  const auto& law = GetParam();
  for (const std::string shape : {"sine", "triangle"}) {
    const std::string type = law.name;
    const auto d = tools::diagram({{"r", reference(shape, "um")},
                                   {"u", block(type + "_inverse", law.parameters(), {"r"})},
                                   {"y", block(type, law.parameters(), {"u"})}},
                                  {"r", "y", "u"});
    const Traces traces = simulated_by_bdf(d, grid(0, 0.4, 400), 1e-9);
    double top = 0;
    for (std::size_t k = 0; k < traces.t.size(); ++k) {
      ASSERT_NEAR(1e6 * traces.values[1][k], 1e6 * traces.values[0][k], law.tolerance) << shape << " row " << k;
      top = std::fmax(top, traces.values[2][k]);
    }
    EXPECT_GT(top, 4.5);  // the command is in volts
  }
}
INSTANTIATE_TEST_SUITE_P(Laws, Compensated,
                         testing::Values(Pair{"bouc_wen", bouc_wen_table, 1e-6},
                                         Pair{"jiles_atherton", jiles_atherton_table, 1e-6},
                                         Pair{"prandtl_ishlinskii", prandtl_ishlinskii_table, 1e-12}),
                         [](const auto& made) { return std::string(made.param.name); });

TEST(LawsInDiagrams, InversesReproduceTheGoldenCommandsOnTheirSteadyLoops) {
  HYSTERON_NEEDS_GOLDEN("ja_inverse_steady_sine");
  auto ja = jiles_atherton_table(), bw = bouc_wen_table();
  ja.emplace_back("origin", "1.421802128 um");
  bw.emplace_back("origin", "1.440072912 um");
  bw.emplace_back("initial", "-1.440072912 um");
  const auto d = tools::diagram({{"r", reference("sine", "um")},
                                 {"ja", block("jiles_atherton_inverse", ja, {"r"})},
                                 {"bw", block("bouc_wen_inverse", bw, {"r"})}},
                                {"ja", "bw"});
  const auto first = golden::read("ja_inverse_steady_sine"), second = golden::read("bw_compensator_steady_sine");
  const Traces traces = simulated_by_bdf(d, first.at("t [s]"), 1e-9);
  for (std::size_t k = 0; k < traces.t.size(); ++k) {  // 10 times the tolerance of numbers up to 5.5 V
    ASSERT_NEAR(traces.values[0][k], first.at("u [V]")[k], 6e-8) << "row " << k;
    ASSERT_NEAR(traces.values[1][k], second.at("u [V]")[k], 6e-8) << "row " << k;
  }
}

TEST(LawsInDiagrams, JilesAthertonInItsOwnDepolarisingFieldSolvesTheLoopOfRates) {
  // H = u - N P: dP/du = F/(1 + N F) with F at H. Followed along the straight way up and back, to 1e-12 of it.
  const jiles_atherton::Params<double> law{.p_s = 55.9973, .a = 48.5843, .alpha = 0.2512, .k = 3.8892, .c = 0.6929};
  const double n = 0.5;
  const auto after = [&](double polarisation, double from, double to) {
    return path::follow(
        [&](double way, double at) {
          const double f = jiles_atherton::slope(law, from + way * (to - from) - n * at, at, to > from ? 1 : -1);
          return f / (1 + n * f) * (to - from);
        },
        polarisation, 1e-12);
  };
  const auto d = tools::diagram({{"u", reference("triangle", "V")},
                                 {"own", block("gain", {{"gain", "0.5 V/um"}}, {"y"})},
                                 {"h", block("sum", {{"signs", "+-"}}, {"u", "own"})},
                                 {"y", block("jiles_atherton", jiles_atherton_table(), {"h"})}},
                                {"y"});
  const Traces traces = simulated_by_bdf(d, {0.025, 0.05, 0.1, 0.15, 0.2, 0.3}, 1e-9);
  const double u[] = {1.5, 3, 6, 3, 0, 6};
  double expected = 0, before = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    expected = after(expected, before, u[k]);
    before = u[k];
    EXPECT_NEAR(1e6 * traces.values[0][k], expected, 1e-7) << k;  // 10 rtol of a way of 10 um
  }
}

TEST(LawsInDiagrams, BacklashLagsByHalfItsGapOnEitherWay) {
  const auto d = tools::diagram(
      {{"u", reference("triangle", "um")}, {"y", block("backlash", {{"gap", "1 um"}}, {"u"})}}, {"u", "y"});
  const Traces traces = simulated_by_bdf(d, {0.05, 0.09, 0.15, 0.19}, 1e-8);
  EXPECT_NEAR(1e6 * (traces.values[0][0] - traces.values[1][0]), 0.5, 1e-9);
  EXPECT_NEAR(1e6 * (traces.values[0][1] - traces.values[1][1]), 0.5, 1e-9);
  EXPECT_NEAR(1e6 * (traces.values[0][2] - traces.values[1][2]), -0.5, 1e-9);
  EXPECT_NEAR(1e6 * (traces.values[0][3] - traces.values[1][3]), -0.5, 1e-9);
}

TEST(LawsInDiagrams, MassHasItsPositionAndItsVelocityAsPorts) {
  // Free motion of a damped oscillator; the integral of the velocity is the change of the position.
  const auto d = tools::diagram(
      {{"force", block("constant", {{"value", "0 N"}})},
       {"mass",
        block("mass_spring_damper",
              {{"mass", "2 kg"}, {"damping", "0.8 N s/m"}, {"stiffness", "50 N/m"}, {"initial_position", "10 mm"}},
              {"force"})},
       {"way", block("integrator", {}, {"mass.velocity"})}},
      {"mass.position", "way"});
  const Traces traces = simulated_by_bdf(d, grid(0, 3, 60), 1e-9);
  const double decay = 0.2, w = std::sqrt(25 - decay * decay);
  for (std::size_t k = 0; k < traces.t.size(); ++k) {
    const double t = traces.t[k];
    const double expected = 0.01 * std::exp(-decay * t) * (std::cos(w * t) + decay / w * std::sin(w * t));
    EXPECT_NEAR(traces.values[0][k], expected, 1e-9);  // 1e-9 of 0.01 m, gathered over 15 radians
    EXPECT_NEAR(traces.values[1][k], expected - 0.01, 1e-9);
  }
}

TEST(LawsInDiagrams, MassOnASpringStartsAtRestUnderItsForce) {
  const auto d = tools::diagram(
      {{"force", block("constant", {{"value", "5 N"}})},
       {"mass", block("mass_on_stiffening_spring",
                      {{"mass", "2 kg"}, {"damping", "0.8 N s/m"}, {"stiffness", "2 N/m"}, {"stiffening", "3 N/m^3"}},
                      {"force"})}},
      {"mass.position", "mass.velocity"});
  const Traces traces = simulated_by_bdf(d, grid(0, 1, 4), 1e-9, true);
  for (const double x : traces.values[0]) EXPECT_NEAR(x, 1, 1e-9);  // 2 x + 3 x^3 = 5
  for (const double v : traces.values[1]) EXPECT_NEAR(v, 0, 1e-9);
}

TEST(LawsInDiagrams, ThermalNetworkWarmsInItsTwoModesAndRestsWhereHeatFlowsThrough) {
  // Two equal bodies, heat into the first: sum and difference decouple, with rates g/C and (g + 2 g12)/C.
  const auto d = tools::diagram({{"first", block("constant", {{"value", "3 W"}})},
                                 {"second", block("constant", {{"value", "0 W"}})},
                                 {"heat", block("mux", {}, {"first", "second"})},
                                 {"ambient", block("constant", {{"value", "20 degC"}})},
                                 {"bodies", block("thermal_network",
                                                  {{"capacities", list({4, 4}, "J/K")},
                                                   {"to_ambient", list({0.2, 0.2}, "W/K")},
                                                   {"between", list({0.7}, "W/K")},
                                                   {"initial", list({20, 20}, "degC")}},
                                                  {"heat", "ambient"})}},
                                {"bodies"});
  const auto expected = [](double t, int body) {
    const double mean = 7.5 * (1 - std::exp(-0.05 * t)), half = 1.5 / 1.6 * (1 - std::exp(-0.4 * t));
    return 293.15 + mean + (body == 0 ? half : -half);
  };
  const Traces traces = simulated_by_bdf(d, grid(0, 40, 20), 1e-9);
  ASSERT_EQ(traces.values.size(), 2u);
  for (std::size_t k = 0; k < traces.t.size(); ++k)
    for (int body = 0; body < 2; ++body)
      EXPECT_NEAR(traces.values[static_cast<std::size_t>(body)][k], expected(traces.t[k], body),
                  3e-6);  // 10 rtol 300 K
  const Traces rest = simulated_by_bdf(d, grid(0, 1, 2), 1e-9, true);
  EXPECT_NEAR(rest.values[0].back(), expected(1e9, 0), 1e-6);
  EXPECT_NEAR(rest.values[1].back(), expected(1e9, 1), 1e-6);
}

TEST(LawsInDiagrams, ThermalNetworkNamesTheLengthOfItsHeat) {
  const auto d = tools::diagram({{"heat", block("constant", {{"value", "3 W"}})},
                                 {"ambient", block("constant", {{"value", "20 degC"}})},
                                 {"bodies", block("thermal_network",
                                                  {{"capacities", list({4, 4}, "J/K")},
                                                   {"to_ambient", list({0.2, 0.2}, "W/K")},
                                                   {"between", list({0.7}, "W/K")},
                                                   {"initial", list({20, 20}, "degC")}},
                                                  {"heat", "ambient"})}},
                                {"bodies"});
  try {
    tools::compiled(d);
    FAIL() << "a single number is no heat for two bodies";
  } catch (const Error& e) {
    ASSERT_EQ(e.problems.size(), 1u);
    EXPECT_EQ(e.problems[0].code, "wrong_length");
    EXPECT_NE(e.problems[0].what.find("2 bodies"), std::string::npos) << e.problems[0].what;
  }
}

TEST(LawsInDiagrams, UnitsOfEveryTypeFitTogether) {
  auto sampled_ja = jiles_atherton_table(), sampled_bw = bouc_wen_table();
  for (auto* p : {&sampled_ja, &sampled_bw}) p->emplace_back("period", "0.1 ms");
  const auto d = tools::diagram(
      {{"r", reference("sine", "um")},
       {"force", block("gain", {{"gain", "2 N/um"}}, {"r"})},
       {"sticky", block("mass_with_friction",
                        {{"mass", "2 g"}, {"coulomb", "1 mN"}, {"breakaway", "2 mN"}, {"stribeck_velocity", "1 mm/s"}},
                        {"force"})},
       {"stopped", block("mass_with_stops", {{"mass", "2 g"}, {"lower", "-1 mm"}, {"upper", "1 mm"}}, {"force"})},
       {"held", block("sample_hold", {{"period", "0.1 ms"}}, {"r"})},
       {"late", block("delay_line", {{"period", "0.1 ms"}, {"samples", 2.0}}, {"held"})},
       {"pid", block("sampled_pid",
                     {{"kp", "1.2 V/um"},
                      {"ki", "7000 V/(um s)"},
                      {"kd", "1e-4 V s/um"},
                      {"lower", "-10 V"},
                      {"upper", "10 V"},
                      {"period", "0.1 ms"}},
                     {"late"})},
       {"filter", block("discrete_transfer_function",
                        {{"num", list({0.1})}, {"den", list({1, -0.9})}, {"period", "0.1 ms"}}, {"pid"})},
       {"converter",
        block("quantizer", {{"bits", 16.0}, {"lower", "-10 V"}, {"upper", "10 V"}, {"period", "0.1 ms"}}, {"filter"})},
       {"amplifier",
        block("current_limit", {{"source", "60 mA"}, {"sink", "60 mA"}, {"capacitance", "2.6 uF"}}, {"converter"})},
       {"slow", block("rate_limiter", {{"rise", "1 V/s"}, {"fall", "2 V/s"}}, {"amplifier"})},
       {"noisy", block("sampled_noise", {{"rms", "1 mV"}, {"period", "1 ms"}}, {"slow"})},
       {"ja", block("sampled_jiles_atherton_inverse", sampled_ja, {"r"})},
       {"bw", block("sampled_bouc_wen_inverse", sampled_bw, {"r"})},
       {"switch",
        block("relay", {{"on_at", "1 V"}, {"off_at", "0 V"}, {"on_value", "3 l/min"}, {"off_value", "0 l/min"}},
              {"noisy"})},
       {"tank", block("tank",
                      {{"area", "2 cm^2"},
                       {"outlet", "1 l/min"},
                       {"reference", "10 cm"},
                       {"law", "square_root"},
                       {"brim", "30 cm"}},
                      {"switch"})}},
      {"sticky.velocity", "stopped.position", "tank.level", "tank.outflow", "tank.spilled", "ja", "bw", "noisy"});
  const auto program = tools::compiled(d);
  const auto dimension = [&](const std::string& s) {
    return program->signals[static_cast<std::size_t>(program->signal(s))].dimension;
  };
  EXPECT_EQ(dimension("sticky.velocity"), parse_unit("m/s").dimension);
  EXPECT_EQ(dimension("stopped.position"), parse_unit("m").dimension);
  EXPECT_EQ(dimension("tank.level"), parse_unit("m").dimension);
  EXPECT_EQ(dimension("tank.outflow"), parse_unit("m^3/s").dimension);
  EXPECT_EQ(dimension("tank.spilled"), parse_unit("m^3").dimension);
  EXPECT_EQ(dimension("ja"), parse_unit("V").dimension);
  EXPECT_EQ(dimension("bw"), parse_unit("V").dimension);
  EXPECT_EQ(dimension("noisy"), parse_unit("V").dimension);
}

}  // namespace
}  // namespace hysteron
