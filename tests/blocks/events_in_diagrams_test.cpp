// Sampled blocks and blocks with modes in whole diagrams, against closed forms and the sampled loops of the thesis.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/rowwise/advance.h"
#include "engine/simulate/exact_advance.h"
#include "tests/blocks/simulated_by_bdf.h"
#include "tests/models/golden.h"

namespace hysteron {
namespace {

using tools::block;
using tools::list;
using tools::simulated_by_bdf;

constexpr double tolerance = 1e-9;

std::vector<double> rows_until(double until, int n, double shift = 0) {
  std::vector<double> t;
  for (int k = 0; k < n; ++k) t.push_back(until * k / n + shift);
  return t;
}
Node sine(const std::string& unit) {
  return block("sine",
               {{"amplitude", "3 " + unit}, {"offset", "3 " + unit}, {"frequency", "5 Hz"}, {"phase", "-90 deg"}});
}

struct Loop {
  const char *golden, *kp, *ki;
  bool step;
};
class SampledLoop : public testing::TestWithParam<Loop> {};
TEST_P(SampledLoop, OfTheThesisIsReproduced) {
  HYSTERON_NEEDS_GOLDEN(GetParam().golden);
  const auto trace = golden::read(GetParam().golden);
  const auto d = tools::diagram(
      {{"r", GetParam().step ? block("constant", {{"value", "1 um"}}) : sine("um")},
       {"error", block("sum", {{"signs", "+-"}}, {"r", "y"})},
       {"u", block("sampled_pid",
                   {{"kp", std::string(GetParam().kp) + " V/um"},
                    {"ki", std::string(GetParam().ki) + " V/(um s)"},
                    {"lower", "-inf V"},
                    {"upper", "inf V"},
                    {"period", "0.1 ms"}},
                   {"error"})},
       {"y",
        block("transfer_function",
              {{"gain", "1 um/V"}, {"num", list({1.377e16})}, {"den", list({1, 2.813e4, 5.403e8, 4.981e12, 1.822e16})}},
              {"u"})}},
      {"y"});
  const Traces traces = simulated_by_bdf(d, trace.at("t [s]"), tolerance);
  for (std::size_t k = 0; k < traces.t.size(); ++k)  // what the traces ask of a sampled loop of the same rule
    ASSERT_NEAR(1e6 * traces.values[0][k], trace.at("y [um]")[k], 1e-8 * (GetParam().step ? 1 : 6)) << "row " << k;
}
INSTANTIATE_TEST_SUITE_P(Traces, SampledLoop,
                         testing::Values(Loop{"loop1_sine_sampled", "1.207", "7009", false},
                                         Loop{"loop2_sine_sampled", "0.5265", "1521", false},
                                         Loop{"loop1_step_sampled", "1.207", "7009", true},
                                         Loop{"loop2_step_sampled", "0.5265", "1521", true}),
                         [](const auto& made) { return std::string(made.param.golden); });

TEST(EventsInDiagrams, SampledInversesPutTheirActuatorsOnTheReferenceAtEveryInstant) {
  // The held command jumps; the actuator follows each jump along its path. Half a period later it still lies there.
  const tools::Parameters ja{
      {"p_s", "55.9973 um"}, {"a", "48.5843 V"}, {"alpha", "0.2512 V/um"}, {"k", "3.8892 V"}, {"c", 0.6929}};
  const tools::Parameters bw{
      {"alpha", "0.6187 um/V"}, {"beta", "0.2418 1/V"}, {"gamma", "0.0237 1/V"}, {"d_p", "1.6126 um/V"}};
  auto sampled_ja = ja, sampled_bw = bw;
  for (auto* p : {&sampled_ja, &sampled_bw}) p->emplace_back("period", "1 ms");
  const auto d = tools::diagram({{"r", sine("um")},
                                 {"u1", block("sampled_jiles_atherton_inverse", sampled_ja, {"r"})},
                                 {"y1", block("jiles_atherton", ja, {"u1"})},
                                 {"u2", block("sampled_bouc_wen_inverse", sampled_bw, {"r"})},
                                 {"y2", block("bouc_wen", bw, {"u2"})}},
                                {"y1", "y2"});
  const Traces traces = simulated_by_bdf(d, rows_until(0.3, 300, 0.5e-3), tolerance);
  for (std::size_t k = 0; k < traces.t.size(); ++k) {
    const double r = 3 - 3 * std::cos(2 * M_PI * 5 * (traces.t[k] - 0.5e-3));
    ASSERT_NEAR(1e6 * traces.values[0][k], r, 1e-6) << "Jiles-Atherton, row " << k;
    ASSERT_NEAR(1e6 * traces.values[1][k], r, 1e-6) << "Bouc-Wen, row " << k;
  }
}

TEST(EventsInDiagrams, HoldDelayAndQuantizerGiveTheSamplesOfTheirInstants) {
  const auto d = tools::diagram(
      {{"u", block("sine", {{"amplitude", "3 V"}, {"frequency", "1 Hz"}})},
       {"held", block("sample_hold", {{"period", "10 ms"}, {"offset", "2 ms"}}, {"u"})},
       {"late", block("delay_line", {{"period", "10 ms"}, {"samples", 3.0}, {"before", "-1 V"}}, {"u"})},
       {"coarse",
        block("quantizer", {{"bits", 4.0}, {"lower", "-4 V"}, {"upper", "4 V"}, {"period", "10 ms"}}, {"u"})}},
      {"held", "late", "coarse"});
  const Traces traces = simulated_by_bdf(d, rows_until(1, 100, 5e-3), tolerance);
  for (int k = 0; k < 100; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const auto u = [](double t) { return 3 * std::sin(2 * M_PI * t); };
    EXPECT_NEAR(traces.values[0][i], u(0.01 * k + 0.002), 1e-12);
    EXPECT_NEAR(traces.values[1][i], k < 3 ? -1 : u(0.01 * (k - 3)), 1e-12);
    EXPECT_NEAR(traces.values[2][i], 0.5 * std::floor(u(0.01 * k) / 0.5 + 0.5), 1e-12) << k;
  }
}

TEST(EventsInDiagrams, RelayAroundAnIntegratorMakesATriangle) {
  // Rises with 2 per second to 1, falls with 2 to -1: period 2 s, from 0 upwards.
  const auto d = tools::diagram(
      {{"switch",
        block("relay", {{"on_at", "1 V"}, {"off_at", "-1 V"}, {"on_value", "-2 V/s"}, {"off_value", "2 V/s"}}, {"y"})},
       {"y", block("integrator", {{"initial", "0 V"}}, {"switch"})}},
      {"y"});
  const Traces traces = simulated_by_bdf(d, rows_until(10, 97), tolerance);
  for (std::size_t k = 0; k < traces.t.size(); ++k)
    EXPECT_NEAR(traces.values[0][k], 2 / M_PI * std::asin(std::sin(M_PI * traces.t[k])), 2e-7) << traces.t[k];
}

TEST(EventsInDiagrams, FrictionTakesTheSameAmplitudeEachHalfCycleUntilTheMassSticks) {
  // k = 100 N/m, friction 10 N, 1 kg: turning points 0.95, -0.75, 0.55, -0.35, 0.15, then stuck at 0.05 (5 N < 10 N).
  const auto d = tools::diagram({{"force", block("constant", {{"value", "0 N"}})},
                                 {"mass", block("mass_with_friction",
                                                {{"mass", "1 kg"},
                                                 {"stiffness", "100 N/m"},
                                                 {"coulomb", "10 N"},
                                                 {"breakaway", "10 N"},
                                                 {"initial_position", "0.95 m"}},
                                                {"force"})}},
                                {"mass.position", "mass.velocity"});
  const double half = M_PI / 10;
  const Traces traces = simulated_by_bdf(d, {half, 2 * half, 3 * half, 4 * half, 5 * half, 2, 5}, tolerance);
  const double expected[] = {-0.75, 0.55, -0.35, 0.15, 0.05, 0.05, 0.05};
  for (std::size_t k = 0; k < 7; ++k)
    EXPECT_NEAR(traces.values[0][k], expected[k], 2e-7) << k;  // 10 rtol of 1 m for each of 16 radians
  EXPECT_EQ(traces.values[1][6], 0) << "it truly sticks";
  EXPECT_EQ(traces.values[0][6], traces.values[0][5]);
}

TEST(EventsInDiagrams, ForceThatGrowsSlowlyBreaksTheMassAwayAtItsInstant) {
  // 5 N/s: sticks until 3 N at 0.6 s, then 0.5 v = 2.5 (t^2 - 0.36) - 2 (t - 0.6).
  const auto d = tools::diagram(
      {{"rate", block("constant", {{"value", "5 N/s"}})},
       {"force", block("integrator", {}, {"rate"})},
       {"mass",
        block("mass_with_friction", {{"mass", "0.5 kg"}, {"coulomb", "2 N"}, {"breakaway", "3 N"}}, {"force"})}},
      {"mass.velocity", "mass.position"});
  const Traces traces = simulated_by_bdf(d, {0.3, 0.59, 0.8, 1}, tolerance);
  EXPECT_EQ(traces.values[1][1], 0);
  for (std::size_t k = 2; k < 4; ++k) {
    const double t = traces.t[k];
    EXPECT_NEAR(traces.values[0][k], (2.5 * (t * t - 0.36) - 2 * (t - 0.6)) / 0.5, 1e-7);
  }
}

TEST(EventsInDiagrams, BouncingMassComesToLieAfterTheSumOfItsBounces) {
  // 10 N on 1 kg, stop 0.8 m away, restitution 0.5: first impact at 0.4 s with 4 m/s; it lies at 0.4 + 0.8 = 1.2 s.
  const auto d = tools::diagram(
      {{"force", block("constant", {{"value", "10 N"}})},
       {"mass",
        block("mass_with_stops",
              {{"mass", "1 kg"}, {"lower", "-1 m"}, {"upper", "0.8 m"}, {"restitution", 0.5}, {"rest_speed", "1 mm/s"}},
              {"force"})}},
      {"mass.position", "mass.velocity"});
  const Traces traces = simulated_by_bdf(d, {0.3, 0.5, 0.9, 1.21, 2}, tolerance);
  EXPECT_NEAR(traces.values[0][0], 0.45, 1e-8);
  EXPECT_NEAR(traces.values[0][1], 0.8 - 2 * 0.1 + 5 * 0.01, 1e-8);  // rebound with 2 m/s
  EXPECT_NEAR(traces.values[0][2], 0.8 - 1 * 0.1 + 5 * 0.01, 1e-8);  // second impact at 0.8 s, rebound with 1 m/s
  EXPECT_EQ(traces.values[0][3], 0.8);
  EXPECT_EQ(traces.values[1][4], 0);
}

TEST(EventsInDiagrams, RateLimiterMakesARampOfAStepAndBreaksNoLoop) {
  // Step of 3 V at 0.1 s: 4 V/s until the gap is 4 x 0.05 = 0.2 V at 0.8 s, then an exponential.
  const auto d =
      tools::diagram({{"u", block("step", {{"before", "0 V"}, {"after", "3 V"}, {"time", "0.1 s"}})},
                      {"y", block("rate_limiter", {{"rise", "4 V/s"}, {"fall", "2 V/s"}, {"time", "50 ms"}}, {"u"})}},
                     {"y"});
  const Traces traces = simulated_by_bdf(d, rows_until(1.5, 60), tolerance);
  for (std::size_t k = 0; k < traces.t.size(); ++k) {
    const double t = traces.t[k] - 0.1;
    const double expected = t < 0 ? 0 : t < 0.7 ? 4 * t : 3 - 0.2 * std::exp(-(t - 0.7) / 0.05);
    EXPECT_NEAR(traces.values[0][k], expected, 1e-7) << traces.t[k];  // the limit is left 1e-6 early: 1e-7 of 0.2
  }
}

TEST(RowsOfRecordings, AreTheSameAsTheirIntegration) {
  // Blocks that pass rows by a closed form, against BDF on their rates (1e-9 of tolerance, some thousand steps).
  const std::vector<double> t{0, 0.1, 0.2, 0.5, 0.6, 1.0, 1.3}, u{0, 1, 0.2, 0.3, 1.4, -0.5, 0.1};
  const std::vector<std::pair<Node, double>> blocks{
      {block("slew_limit", {{"rate", "4 V/s"}, {"fall", "2 V/s"}, {"time", "20 ms"}}, {"u"}), 1e-6},
      {block("late_prandtl_ishlinskii",
             {{"thresholds", list({0, 0.3, 0.6}, "V")}, {"weights", list({1, 0.3, 0.2}, "V/V")}, {"time", "50 ms"}},
             {"u"}),
       1e-6},
      {block("mains_interference",
             {{"frequency", "1.3 Hz"}, {"cosine", list({0.4, 0.1}, "V")}, {"sine", list({-0.2, 0.3}, "V")}}, {"u"}),
       1e-12}};
  for (const auto& [node, tolerance_of] : blocks) {
    const auto program = tools::compiled(tools::diagram({{"y", node}}, {"y"}, {{"u", "V"}}));
    auto run = start(*program);
    bind_input(*program, run, "u", tools::series(t, u));
    SimulateOptions options;
    options.instants = rows_until(1.3, 400);
    options.until = options.instants.back();
    options.relative_tolerance = tolerance;
    options.method = Method::exact;
    const auto rows = simulate(*program, run, options);
    options.method = Method::bdf;
    const auto integrated = simulate(*program, run, options);
    EXPECT_LT(tools::distance(rows.values[0], integrated.values[0]), tolerance_of) << node.type;
    EXPECT_GT(tools::distance(rows.values[0], std::vector<double>(rows.values[0].size(), 0.0)), 0.1);
  }
}

TEST(EventsInDiagrams, TankSpillsItsSurplusAndKeepsTheBalance) {
  // Inflow 2 l/s for 3 s into 0.1 m^2 with brim 20 cm (20 l), linear outlet 1 l/s at 20 cm: h = 40 cm (1 - e^(-t/20
  // s)), full at 20 ln 2 = 13.86 s; then 1 l/s runs over until the inflow stops at 20 s.
  const auto d = tools::diagram(
      {{"inflow", block("step", {{"before", "2 l/s"}, {"after", "0 l/s"}, {"time", "20 s"}})},
       {"tank", block("tank", {{"area", "0.1 m^2"}, {"outlet", "1 l/s"}, {"reference", "20 cm"}, {"brim", "20 cm"}},
                      {"inflow"})}},
      {"tank.level", "tank.spilled", "tank.outflow"});
  const Traces traces = simulated_by_bdf(d, {5, 10, 16, 20, 30}, tolerance);
  const double full = 20 * std::log(2);
  EXPECT_NEAR(traces.values[0][0], 0.4 * (1 - std::exp(-0.25)), 1e-8);
  EXPECT_NEAR(traces.values[0][1], 0.4 * (1 - std::exp(-0.5)), 1e-8);
  EXPECT_EQ(traces.values[0][2], 0.2);
  // the film of 1 nm on 0.1 m^2, and 10 rtol of 20 l
  EXPECT_NEAR(traces.values[1][2], 1e-3 * (16 - full), 3e-10);
  EXPECT_NEAR(traces.values[1][4], 1e-3 * (20 - full), 3e-10);
  EXPECT_NEAR(traces.values[0][4], 0.2 * std::exp(-0.5), 1e-8);
  EXPECT_NEAR(traces.values[2][3], 1e-3, 1e-12);
}

TEST(EventsInDiagrams, RowByRowATankIsHeldAtItsBrimWithinTheRow) {
  // As above, 100 substeps of a row of 0.1 s: water that is above the brim within one substep of 1 ms is spilled at its
  // end, after an outflow that is at most 1 l/s too large for 1 ms: 1e-6 m^3 of 6e-3.
  const auto d = tools::diagram(
      {{"tank",
        block("tank", {{"area", "0.1 m^2"}, {"outlet", "1 l/s"}, {"reference", "20 cm"}, {"brim", "20 cm"}}, {"q"})}},
      {"tank.level", "tank.spilled"}, {{"q", "m^3/s"}});
  const auto program = tools::compiled(d);
  EXPECT_EQ(why_not_exact(*program), "");
  auto run = start(*program);
  bind_input(*program, run, "q", tools::series({0, 20, 40}, {2e-3, 0, 0}, Between::hold));
  std::vector<std::vector<double>> values;
  const auto instants = tools::grid(0, 30, 300);
  Advance advance(program, program->record_signals);
  EXPECT_TRUE(advance.integrates());
  advance(run, instants, {.substeps = 100, .at_rest = false}, values);
  const double full = 20 * std::log(2);
  EXPECT_NEAR(values[0][50], 0.4 * (1 - std::exp(-0.25)), 1e-12);  // nothing but Runge-Kutta: (h/20 s)^4
  EXPECT_EQ(values[0][160], 0.2);
  EXPECT_NEAR(values[1][160], 1e-3 * (16 - full), 1e-6);
  EXPECT_NEAR(values[1][300], 1e-3 * (20 - full), 1e-6);
  EXPECT_NEAR(values[0][300], 0.2 * std::exp(-0.5), 1e-12);
  // A run that may choose finds the events, and one that asks for rows is told what stands in the way.
  SimulateOptions options;
  options.instants = instants;
  options.until = 30;
  EXPECT_FALSE(advances_exactly(*program, options));
  options.method = Method::exact;
  try {
    simulate(*program, run, options);
    ADD_FAILURE() << "a tank was advanced exactly";
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().path, "tank");
    EXPECT_NE(std::string(e.what()).find("changes its mode at events"), std::string::npos) << e.what();
  }
}

TEST(EventsInDiagrams, InALoopATankIsAdvancedRowByRow) {
  // h' = 2 (1.5 m - h)/s - h/s from an empty tank: h = (1 - exp(-3 t)) m.
  const auto program = tools::compiled(tools::diagram(
      {{"lack", block("sum", {{"signs", "+-"}}, {"h", "tank.level"})},
       {"pump", block("gain", {{"gain", "2 m^2/s"}}, {"lack"})},
       {"tank", block("tank", {{"area", "1 m^2"}, {"outlet", "1 m^3/s"}, {"reference", "1 m"}}, {"pump"})}},
      {"tank.level"}, {{"h", "m"}}));
  EXPECT_EQ(why_not_exact(*program), "");
  const auto t = tools::grid(0, 2, 200);
  auto run = start(*program);
  bind_input(*program, run, "h", tools::series(t, std::vector<double>(t.size(), 1.5)));
  std::vector<std::vector<double>> level;
  Advance(program, program->record_signals)(run, t, {.at_rest = false}, level);
  // Runge-Kutta: 0.03^5/120 a row, a few dozen rows within a time constant.
  for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(level[0][i], 1 - std::exp(-3 * t[i]), 1e-8) << t[i];
}

TEST(EventsInDiagrams, CurrentLimitSlewsTheStaircaseOfAConverter) {
  // 60 mA into 2 uF: 30 V/ms. A converter at 1 kHz behind a fast ramp makes steps of 20 V: 0.67 ms each.
  const auto d = tools::diagram(
      {{"slope", block("constant", {{"value", "20 V/ms"}})},
       {"ramp", block("integrator", {}, {"slope"})},
       {"dac", block("sample_hold", {{"period", "1 ms"}}, {"ramp"})},
       {"y", block("current_limit", {{"source", "60 mA"}, {"sink", "60 mA"}, {"capacitance", "2 uF"}, {"time", "1 us"}},
                   {"dac"})}},
      {"y"});
  const Traces traces = simulated_by_bdf(d, {1.1e-3, 1.5e-3, 1.9e-3, 2.5e-3}, tolerance);
  EXPECT_NEAR(traces.values[0][0], 3, 1e-6);
  EXPECT_NEAR(traces.values[0][1], 15, 1e-6);
  EXPECT_NEAR(traces.values[0][2], 20, 1e-6);
  EXPECT_NEAR(traces.values[0][3], 35, 1e-6);
}

}  // namespace
}  // namespace hysteron
