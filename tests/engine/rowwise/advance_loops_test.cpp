// Feedback loops with nonlinear blocks in the exact advance: against one block that holds the whole law, closed forms
// and the integrator.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/rowwise/advance.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;
using Blocks = std::vector<std::pair<std::string, Node>>;
using Values = std::vector<std::vector<double>>;

SeriesPointer wave(double until, int rows, Between between = Between::linear) {
  const auto t = grid(0, until, rows);
  std::vector<double> v;
  for (const double s : t) v.push_back(2 - 2 * std::cos(31 * s) + 0.5 * std::sin(83 * s));
  return series(t, v, between);
}

/// x'' = u - 80 x' - 1e5 x - 4e9 x^3, of gains, sums, products and integrators.
Blocks oscillator() {
  return {{"damping", block("gain", {{"gain", "80 1/s"}}, {"v"})},
          {"spring", block("gain", {{"gain", "1e5 1/s^2"}}, {"x"})},
          {"square", block("product", {}, {"x", "x"})},
          {"cube", block("product", {}, {"square", "x"})},
          {"stiffening", block("gain", {{"gain", "4e9 1/(m^2 s^2)"}}, {"cube"})},
          {"force", block("gain", {{"gain", "1 m/(V s^2)"}}, {"u"})},
          {"a", block("sum", {{"signs", "+---"}}, {"force", "damping", "spring", "stiffening"})},
          {"v", block("integrator", {}, {"a"})},
          {"x", block("integrator", {}, {"v"})}};
}

Traces traces_of(const Blocks& blocks, const std::vector<std::string>& record, const SeriesPointer& u, Method method,
                 double tolerance, bool at_rest = false) {
  const auto program = compiled(diagram(blocks, record, {{"u", "V"}}));
  auto run = start(*program);
  bind_input(*program, run, "u", u);
  SimulateOptions options{.method = method, .relative_tolerance = tolerance, .at_rest = at_rest};
  options.instants = u->t;
  return simulate(*program, run, options);
}

/// By the exact advance and by bdf, relative to the largest value.
double disagreement(const Blocks& blocks, const std::vector<std::string>& record, const SeriesPointer& u,
                    double tolerance, bool at_rest = false) {
  const auto ours = traces_of(blocks, record, u, Method::exact, tolerance, at_rest);
  EXPECT_EQ(ours.statistics.method, "exact");
  const auto bdf = traces_of(blocks, record, u, Method::bdf, tolerance, at_rest);
  return relative_distance(ours.values, bdf.values);
}

TEST(AdvanceLoops, ACubicSpringOfBlocksIsTheMassOnAStiffeningSpring) {
  const auto u = wave(0.4, 800);
  const Blocks mass{
      {"force", block("gain", {{"gain", "1 N/V"}}, {"u"})},
      {"m", block("mass_on_stiffening_spring",
                  {{"mass", "1 kg"}, {"damping", "80 N s/m"}, {"stiffness", "1e5 N/m"}, {"stiffening", "4e9 N/m^3"}},
                  {"force"})}};
  const auto values = [&](const Blocks& blocks, const std::string& signal) {
    const auto program = compiled(diagram(blocks, {signal}, {{"u", "V"}}));
    EXPECT_EQ(why_not_exact(*program), "");
    auto run = start(*program);
    bind_input(*program, run, "u", u);
    Values result;
    Advance(program, program->record_signals)(run, u->t, {.substeps = 16, .at_rest = false}, result);
    return result[0];
  };
  // Runge-Kutta in steps of a hundredth of a radian, 130 radians: (1/100)^4/120 of each.
  const auto one = values(mass, "m.position"), many = values(oscillator(), "x");
  EXPECT_LT(distance(one, many), 1e-8 * largest(one));
}

TEST(AdvanceLoops, TheyAgreeWithTheIntegrator) {
  // Ten times the tolerance is what either may be off by.
  EXPECT_LT(disagreement(oscillator(), {"x", "v"}, wave(0.4, 400), 1e-6), 20e-6);
  EXPECT_LT(disagreement(oscillator(), {"x"}, wave(0.4, 400), 1e-6, true), 20e-6);
  EXPECT_LT(disagreement(oscillator(), {"x"}, wave(0.4, 100, Between::hold), 1e-6), 20e-6);
}

Blocks hysteretic_loop(const Node& law, const std::string& gain) {
  return {{"reference", block("gain", {{"gain", "1 um/V"}}, {"u"})},
          {"error", block("sum", {{"signs", "+-"}}, {"reference", "x"})},
          {"c", block("pi_controller", {{"kp", Number{0.4, "V/um"}}, {"ki", "150 V/(um s)"}}, {"error"})},
          {"law", law},
          {"g", block("gain", {{"gain", gain}}, {"law"})},
          {"x", block("lag", {{"times", list({0.002}, "s")}}, {"g"})}};
}

TEST(AdvanceLoops, HysteresisInAClosedLoopAgreesWithTheIntegrator) {
  EXPECT_LT(disagreement(hysteretic_loop(thesis_bouc_wen("c"), "1"), {"x", "c", "law"}, wave(0.3, 300), 1e-6), 20e-6);
  EXPECT_LT(disagreement(hysteretic_loop(thesis_operators("c"), "1"), {"x", "c"}, wave(0.3, 300), 1e-5), 20e-5);
  EXPECT_LT(disagreement(hysteretic_loop(block("play", {{"radius", "0.3 V"}}, {"c"}), "1 um/V"), {"x"}, wave(0.3, 300),
                         1e-5, true),
            20e-5);
  // Jumps of the reference pass the controller at once: the law follows them as paths.
  EXPECT_LT(disagreement(hysteretic_loop(thesis_bouc_wen("c"), "1"), {"x", "c"}, wave(0.3, 60, Between::hold), 1e-6),
            20e-6);
}

TEST(AdvanceLoops, WhatStandsBehindThemIsAdvancedToo) {
  auto blocks = oscillator();
  blocks.push_back({"micro", block("gain", {{"gain", "1e5 V/m"}}, {"x"})});
  blocks.push_back({"w", block("play", {{"radius", "0.5 V"}}, {"micro"})});
  blocks.push_back({"y", block("lag", {{"times", list({0.004}, "s")}}, {"w"})});
  EXPECT_LT(disagreement(blocks, {"w", "y"}, wave(0.4, 400), 1e-5), 20e-5);
}

TEST(AdvanceLoops, TheSameRowByRowAndManyAtOnce) {
  // A sampled block that never runs: point by point.
  auto blocks = oscillator();
  const auto u = wave(0.4, 700);
  const auto values = [&](const Blocks& all, std::vector<std::string> record) {
    const auto program = compiled(diagram(all, std::move(record), {{"u", "V"}}));
    auto run = start(*program);
    bind_input(*program, run, "u", u);
    Values result;
    Advance(program, program->record_signals)(run, u->t, {.substeps = 2}, result);
    return result[0];
  };
  const auto fast = values(blocks, {"x"});
  blocks.push_back({"never", block("sample_hold", {{"period", "1 s"}, {"offset", "1000 s"}}, {"u"})});
  const auto slow = values(blocks, {"x", "never"});
  EXPECT_LT(distance(fast, slow), 1e-12 * largest(fast));
}

Blocks following(Node law, const char* speed) {
  return {{"e", block("sum", {{"signs", "+-"}}, {"u", "x"})},
          {"law", std::move(law)},
          {"speed", block("gain", {{"gain", speed}}, {"law"})},
          {"x", block("integrator", {}, {"speed"})}};
}

TEST(AdvanceLoops, WhatDecaysAtOnceIsTakenExactly) {
  // A time constant of 10 ns behind a limit that nothing reaches.
  const Blocks blocks = following(block("saturation", {{"lower", "-100 V"}, {"upper", "100 V"}}, {"e"}), "1e8 1/s");
  const auto u = wave(0.4, 40);
  const auto traces = traces_of(blocks, {"x"}, u, Method::exact, 1e-6);
  for (std::size_t k = 0; k < u->t.size(); ++k) EXPECT_NEAR(traces.values[0][k], u->v[k], 1e-6);
}

TEST(AdvanceLoops, WhatIsTooStiffIsLeftToTheIntegrator) {
  // Within 10 mV of its input it stands still, beyond it follows in 1 us: where the input turns rows of 10 ms would
  // have to be split into ten thousand steps.
  const Blocks blocks = following(block("dead_zone", {{"lower", "-10 mV"}, {"upper", "10 mV"}}, {"e"}), "1e6 1/s");
  std::vector<double> t, v;
  for (int k = 0; k < 40; ++k) {
    t.push_back(0.01 * k);
    v.push_back(0.4 * std::sin(7 * t.back()));
  }
  const auto u = series(t, v, Between::linear);
  EXPECT_NE(traces_of(blocks, {"x"}, u, Method::automatic, 1e-6).statistics.method, "exact");
  try {
    traces_of(blocks, {"x"}, u, Method::exact, 1e-6);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    const auto& code = error.problems.front().code;
    EXPECT_TRUE(code == "not_fine_enough" || code == "diverged") << code;
  }
}

TEST(AdvanceLoops, SaysWhatStandsInTheWay) {
  const auto why = [](const Blocks& blocks, const std::string& last) {
    return why_not_exact(*compiled(diagram(blocks, {last}, {{"u", "V"}})));
  };
  const Node bent = block("saturation", {{"lower", "-1 V"}, {"upper", "1 V"}}, {"e"});
  EXPECT_NE(why({{"e", block("sum", {{"signs", "+-"}}, {"u", "late"})},
                 {"limited", bent},
                 {"x", block("lag", {{"times", list({0.01}, "s")}}, {"limited"})},
                 {"late", block("dead_time", {{"delay", "1 ms"}}, {"x"})}},
                "x")
                .find("dead_time \"late\" is a dead time and stands in a feedback loop"),
            std::string::npos);
  EXPECT_NE(why({{"e", block("sum", {{"signs", "+-"}}, {"u", "half"})},
                 {"limited", bent},
                 {"half", block("gain", {{"gain", 0.5}}, {"limited"})}},
                "half")
                .find("algebraic loop"),
            std::string::npos);
}

}  // namespace
}  // namespace hysteron
