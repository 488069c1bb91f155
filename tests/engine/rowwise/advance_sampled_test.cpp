// Sampled blocks in the exact advance: recursions of the zero-order hold written by hand, and the integrator.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/rowwise/advance.h"
#include "models/random.h"
#include "tests/engine/event_blocks.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;
using Blocks = std::vector<std::pair<std::string, Node>>;

// Against recursions that take the same steps: rounding, added up over some hundred instants of a stable loop.
constexpr double rounding = 1e-12;

ProgramPointer with_events(const Diagram& d) { return compile(d, test::registry_with_events()); }

Traces run_to(const Program& program, double until, double every, Method method = Method::automatic, double rtol = 1e-9,
              bool at_rest = false) {
  return simulate(program, start(program),
                  {.until = until, .every = every, .method = method, .relative_tolerance = rtol, .at_rest = at_rest});
}

/// Largest difference between the exact advance and bdf, relative to the largest value, over all signals.
double disagreement(const Program& program, double until, double every, bool at_rest = false) {
  const auto ours = run_to(program, until, every, Method::automatic, 1e-9, at_rest);
  EXPECT_EQ(ours.statistics.method, "exact") << why_not_exact(program);
  const auto bdf = run_to(program, until, every, Method::bdf, 1e-9, at_rest);
  EXPECT_EQ(ours.statistics.samples, bdf.statistics.samples);
  double worst = 0;
  for (std::size_t s = 0; s < ours.values.size(); ++s)
    worst = std::max(worst, distance(ours.values[s], bdf.values[s]) / largest(bdf.values[s]));
  return worst;
}

Node pi(const std::string& in, const std::string& period = "1 ms", double kp = 0.8, double ki = 120) {
  return block("sampled_pid",
               {{"kp", kp},
                {"ki", Number{ki, "1/s"}},
                {"lower", "-inf V"},
                {"upper", "inf V"},
                {"rule", "forward"},
                {"anti_windup", "none"},
                {"period", period}},
               {in});
}
Node sine() { return block("sine", {{"amplitude", "2 V"}, {"frequency", "7 Hz"}}); }
double sine_at(double t) { return 2 * std::sin(2 * M_PI * 7 * t); }
Node error_of(const std::string& y) { return block("sum", {{"signs", "+-"}}, {"reference", y}); }
Node lag(const std::string& in, double tau = 0.004) { return block("lag", {{"times", list({tau}, "s")}}, {in}); }

/// PI control with period 1 ms of x' = (w - x)/tau, w what `drive` makes of a command; x at t.
template <class Drive, class Measured>
std::vector<double> loop_by_hand(const std::vector<double>& t, double tau, Drive drive, Measured measured) {
  const double period = 1e-3;
  std::vector<double> result;
  double x = 0, integral = 0, w = 0;
  long k = -1;
  for (const double time : t) {
    while (static_cast<double>(k + 1) * period <= time + 1e-12) {
      if (k >= 0) x = w + (x - w) * std::exp(-period / tau);
      ++k;
      const double e = sine_at(static_cast<double>(k) * period) - measured(x, k);
      w = drive(0.8 * e + integral);
      integral += 120 * period * e;
    }
    result.push_back(w + (x - w) * std::exp(-(time - static_cast<double>(k) * period) / tau));
  }
  return result;
}

TEST(AdvanceSampled, AControllerAroundALagIsTheRecursionOfItsZeroOrderHold) {
  const auto program = with_events(
      diagram({{"reference", sine()}, {"e", error_of("x")}, {"c", pi("e")}, {"x", lag("c")}}, {"x", "reference", "e"}));
  for (const double every : {1e-3, 0.37e-3, 2.1e-3}) {  // at the instants, between them, and past some of them
    const auto traces = run_to(*program, 0.4, every);
    EXPECT_EQ(traces.statistics.method, "exact");
    EXPECT_EQ(traces.statistics.samples, 1 + static_cast<long>(traces.t.back() / 1e-3 + 1e-9));
    const auto x = loop_by_hand(
        traces.t, 0.004, [](double u) { return u; }, [](double y, long) { return y; });
    EXPECT_LT(distance(trace(traces), x), rounding) << every;
    for (std::size_t i = 0; i < traces.t.size(); ++i) {
      // what is a function of time is asked for at every row
      EXPECT_NEAR(traces.values[1][i], sine_at(traces.t[i]), 1e-13);
      EXPECT_NEAR(traces.values[2][i], sine_at(traces.t[i]) - traces.values[0][i], 1e-13);
    }
  }
}

TEST(AdvanceSampled, RecordedRowsBesideTheInstantsChangeNothing) {
  const auto program = with_events(diagram(
      {{"e", block("sum", {{"signs", "+-"}}, {"u", "x"})}, {"c", pi("e")}, {"x", lag("c")}}, {"x"}, {{"u", "V"}}));
  auto run = start(*program);
  std::vector<double> t, v;
  for (int k = 0; k < 900; ++k) {
    t.push_back(0.00047 * k);
    v.push_back(sine_at(t.back()));
  }
  bind_input(*program, run, "u", series(t, v));
  SimulateOptions options{.until = 0.4, .every = 1e-3, .relative_tolerance = 1e-9};
  const auto ours = simulate(*program, run, options);
  EXPECT_EQ(ours.statistics.method, "exact");
  // x' = (c - x)/tau between instants, c from u at the instants.
  double x = 0, c = 0, integral = 0;
  const auto u = series(t, v);
  for (std::size_t k = 0; k < ours.t.size(); ++k) {
    if (k > 0) x = c + (x - c) * std::exp(-1e-3 / 0.004);
    EXPECT_NEAR(trace(ours)[k], x, rounding) << k;
    const double e = u->value(ours.t[k], ours.t[k]) - x;
    c = 0.8 * e + integral;
    integral += 0.12 * e;
  }
}

TEST(AdvanceSampled, SeveralRatesAndOffsetsMeetAsTheirTicksSay) {
  // In ticks of 0.25 ms: s adds up 1 - x at 1, 5, 9 ...; h holds x at 2, 14, 26 ...; x' = (s - h/2 - x)/tau.
  const auto program = with_events(
      diagram({{"one", block("constant", {{"value", "1 V"}})},
               {"e", block("sum", {{"signs", "+-"}}, {"one", "x"})},
               {"s", block("test_accumulator", {{"gain", 0.05}, {"period", "1 ms"}, {"offset", "0.25 ms"}}, {"e"})},
               {"h", block("sample_hold", {{"period", "3 ms"}, {"offset", "0.5 ms"}}, {"x"})},
               {"half", block("gain", {{"gain", 0.5}}, {"h"})},
               {"drive", block("sum", {{"signs", "+-"}}, {"s", "half"})},
               {"x", lag("drive")}},
              {"x", "s", "h"}));
  const auto traces = run_to(*program, 0.3, 0.05e-3);
  double x = 0, sum = 0, s = 0, h = 0, from = 0;
  std::size_t i = 0;
  for (long tick = 0; tick <= 1200; ++tick) {
    const double t = static_cast<double>(tick) * 0.25e-3;
    const auto x_at = [&](double time) {
      const double w = s - h / 2;
      return w + (x - w) * std::exp(-(time - from) / 0.004);
    };
    for (; i < traces.t.size() && traces.t[i] < t - 1e-12; ++i)
      EXPECT_NEAR(traces.values[0][i], x_at(traces.t[i]), rounding);
    x = x_at(t);
    from = t;
    if (tick % 4 == 1) {
      s = sum;
      sum += 0.05 * (1 - x);
    }
    if (tick % 12 == 2) h = x;
    if (i < traces.t.size() && traces.t[i] < t + 1e-12) {
      EXPECT_NEAR(traces.values[1][i], s, rounding) << t;
      EXPECT_NEAR(traces.values[2][i], h, rounding) << t;
    }
  }
  EXPECT_EQ(i, traces.t.size() - 1);
  EXPECT_LT(disagreement(*program, 0.3, 0.05e-3), 1e-7);
}

TEST(AdvanceSampled, PlayInTheLoopFollowsTheJumpsAndNeedsNoSubsteps) {
  const auto program = with_events(diagram({{"reference", sine()},
                                            {"e", error_of("x")},
                                            {"c", pi("e")},
                                            {"w", block("play", {{"radius", "0.3 V"}}, {"c"})},
                                            {"x", lag("w")}},
                                           {"x"}));
  EXPECT_TRUE(Advance(program, program->record_signals).exact_without_substeps());
  const auto traces = run_to(*program, 0.4, 0.37e-3);
  EXPECT_EQ(traces.statistics.method, "exact");
  double w = 0;
  const auto x = loop_by_hand(
      traces.t, 0.004, [&](double u) { return w = std::max(u - 0.3, std::min(u + 0.3, w)); },
      [](double y, long) { return y; });
  EXPECT_LT(distance(trace(traces), x), rounding);
  EXPECT_LT(disagreement(*program, 0.4, 0.37e-3), 1e-7);  // the error of bdf after 400 restarts
}

TEST(AdvanceSampled, PlayBehindThePlantIsRefinedUntilNothingMoves) {
  const auto program = with_events(diagram({{"reference", sine()},
                                            {"e", error_of("w")},
                                            {"c", pi("e", "1 ms", 0.5, 60)},
                                            {"x", lag("c")},
                                            {"w", block("play", {{"radius", "0.3 V"}}, {"x"})}},
                                           {"x", "w"}));
  EXPECT_FALSE(Advance(program, program->record_signals).exact_without_substeps());
  EXPECT_LT(disagreement(*program, 0.3, 0.5e-3), 1e-7);
}

TEST(AdvanceSampled, ADeadTimeHandsTheStaircaseOnAtItsOwnInstants) {
  // Delays of 2.3 and of 2 periods: x' = (s(t - delay) - x)/tau, s the accumulator of 1 - x, zero before its start.
  for (const double delay : {2.3e-3, 2e-3}) {
    const auto program =
        with_events(diagram({{"one", block("constant", {{"value", "1 V"}})},
                             {"e", block("sum", {{"signs", "+-"}}, {"one", "x"})},
                             {"s", block("test_accumulator", {{"gain", 0.05}, {"period", "1 ms"}}, {"e"})},
                             {"late", block("dead_time", {{"delay", Number{delay, "s"}}}, {"s"})},
                             {"x", lag("late")}},
                            {"x", "late"}));
    EXPECT_TRUE(Advance(program, program->record_signals).exact_without_substeps());
    const auto traces = run_to(*program, 0.3, 1e-3);
    EXPECT_EQ(traces.statistics.method, "exact");
    std::vector<double> s{0};
    double x = 0;
    const double part = delay - 2e-3;  // of a period
    const auto held = [&](long k) { return k < 0 ? 0.0 : s[static_cast<std::size_t>(k)]; };
    for (long k = 0; k <= 300; ++k) {
      const double before = held(k - 3), behind = held(k - 2);
      EXPECT_NEAR(traces.values[0][static_cast<std::size_t>(k)], x, rounding) << k;
      EXPECT_NEAR(traces.values[1][static_cast<std::size_t>(k)], part > 1e-9 ? before : behind, rounding) << k;
      s.push_back(s.back() + 0.05 * (1 - x));
      x = before + (x - before) * std::exp(-part / 0.004);
      x = behind + (x - behind) * std::exp(-(1e-3 - part) / 0.004);
    }
    EXPECT_LT(disagreement(*program, 0.3, 1e-3), 1e-7);
  }
}

TEST(AdvanceSampled, TwoDeadTimesInARowAddUp) {
  const Blocks common{{"one", block("constant", {{"value", "1 V"}})},
                      {"e", block("sum", {{"signs", "+-"}}, {"one", "x"})},
                      {"s", block("test_accumulator", {{"gain", 0.05}, {"period", "1 ms"}}, {"e"})}};
  auto one = common, two = common;
  one.insert(one.end(), {{"late", block("dead_time", {{"delay", "2.3 ms"}}, {"s"})}, {"x", lag("late")}});
  two.insert(two.end(), {{"first", block("dead_time", {{"delay", "1.6 ms"}}, {"s"})},
                         {"second", block("dead_time", {{"delay", "0.7 ms"}}, {"first"})},
                         {"x", lag("second")}});
  const auto a = run_to(*with_events(diagram(one, {"x"})), 0.2, 0.37e-3);
  const auto b = run_to(*with_events(diagram(two, {"x"})), 0.2, 0.37e-3);
  EXPECT_EQ(b.statistics.method, "exact");
  EXPECT_LT(distance(trace(a), trace(b)), rounding);
}

TEST(AdvanceSampled, NoiseIsThatOfTheInstant) {
  // Drawn by a sampled block, and by a sensor in front of the sampling.
  for (const bool sensor : {false, true}) {
    const Node noise =
        block(sensor ? "sensor_noise" : "sampled_noise", {{"rms", "0.1 V"}, {"seed", 5.0}, {"period", "1 ms"}}, {"x"});
    const auto program = with_events(
        diagram({{"reference", sine()}, {"e", error_of("m")}, {"c", pi("e")}, {"x", lag("c")}, {"m", noise}}, {"x"}));
    const auto traces = run_to(*program, 0.2, 0.37e-3);
    EXPECT_EQ(traces.statistics.method, "exact");
    const std::uint64_t stream =
        program->blocks.at(static_cast<std::size_t>(program->block_index("m"))).key + (sensor ? 1 : 2);
    const auto x = loop_by_hand(
        traces.t, 0.004, [](double u) { return u; },
        [&](double y, long k) { return y + 0.1 * random::normal(5, stream, static_cast<std::uint64_t>(k)); });
    EXPECT_LT(distance(trace(traces), x), rounding) << sensor;
  }
}

TEST(AdvanceSampled, ACornerAtAnInstantIsPassedBeforeTheSample) {
  const auto program =
      with_events(diagram({{"jump", block("step", {{"before", "0 V"}, {"after", "1 V"}, {"time", "0.3 s"}})},
                           {"held", block("sample_hold", {{"period", "0.1 s"}}, {"jump"})},
                           {"x", block("integrator", {}, {"held"})}},
                          {"held", "x"}));
  const auto traces = run_to(*program, 1, 0.05);
  EXPECT_EQ(traces.statistics.method, "exact");
  for (std::size_t i = 0; i < traces.t.size(); ++i) {
    EXPECT_EQ(traces.values[0][i], i < 6 ? 0.0 : 1.0) << i;
    EXPECT_NEAR(traces.values[1][i], std::max(0.0, traces.t[i] - 0.3), rounding) << i;
  }
}

TEST(AdvanceSampled, WhatStandsBetweenSampledBlocksIsPassedInTheSameInstant) {
  // reference -> sampler -> lead filter (states, and feeds through) -> play -> sampler, all at one instant.
  const auto program = with_events(
      diagram({{"reference", sine()},
               {"first", block("sample_hold", {{"period", "1 ms"}}, {"reference"})},
               {"lead", block("transfer_function", {{"num", list({0.01, 1})}, {"den", list({0.005, 1})}}, {"first"})},
               {"sum", block("sum", {}, {"lead", "first"})},
               {"w", block("play", {{"radius", "0.3 V"}}, {"sum"})},
               {"second", block("sample_hold", {{"period", "1 ms"}}, {"w"})},
               {"x", lag("second")}},
              {"second", "x"}));
  const auto traces = run_to(*program, 0.3, 1e-3);
  // lead = 2 - 1/(0.005 s + 1): y = 2 u - z, z' = (u - z)/0.005.
  double z = 0, w = 0, u = 0;
  for (std::size_t k = 0; k < traces.t.size(); ++k) {
    if (k > 0) z = u + (z - u) * std::exp(-1e-3 / 0.005);
    // between the instants the filter moves and the play with it; then both jump
    if (k > 0) w = std::max(3 * u - z - 0.3, std::min(3 * u - z + 0.3, w));
    u = sine_at(1e-3 * static_cast<double>(k));
    w = std::max(3 * u - z - 0.3, std::min(3 * u - z + 0.3, w));
    EXPECT_NEAR(traces.values[0][k], w, rounding) << k;
  }
  EXPECT_LT(disagreement(*program, 0.3, 1e-3), 1e-7);
}

TEST(AdvanceSampled, AJumpThroughABentBlockTurnsTheMemoryOnItsWay) {
  // From -1 to 1 the square falls to zero and rises again: play sees the turn, as in the integrator.
  const auto program = with_events(diagram({{"reference", sine()},
                                            {"held", block("sample_hold", {{"period", "20 ms"}}, {"reference"})},
                                            {"square", block("product", {}, {"held", "held"})},
                                            {"w", block("play", {{"radius", "0.3 V^2"}}, {"square"})},
                                            {"x", block("lag", {{"times", list({0.004}, "s")}}, {"w"})}},
                                           {"w", "x"}));
  EXPECT_LT(disagreement(*program, 1, 0.01), 1e-7);
}

TEST(AdvanceSampled, ALoopOfCompensatorControllerCreepAndDelayAgreesWithTheIntegrator) {
  const auto program = with_events(diagram(
      {{"reference", sine()},
       {"e", error_of("measured")},
       {"c", pi("e", "1 ms", 0.3, 60)},
       {"forward", block("delay_line", {{"samples", 1.0}, {"period", "2 ms"}, {"offset", "0.5 ms"}}, {"reference"})},
       {"drive", block("sum", {}, {"c", "forward"})},
       {"limited", block("saturation", {{"lower", "-1.9 V"}, {"upper", "1.9 V"}}, {"drive"})},
       {"w", block("play", {{"radius", "0.2 V"}}, {"limited"})},
       {"creep", block("creep", {{"amounts", list({0.02, 0.03})}, {"times", list({0.1, 1}, "s")}}, {"w"})},
       {"x", lag("creep", 0.002)},
       {"y", lag("x", 0.003)},
       {"noisy", block("sampled_noise", {{"rms", "1 mV"}, {"period", "1 ms"}}, {"y"})},
       {"measured", block("delay_line", {{"samples", 1.0}, {"period", "1 ms"}}, {"noisy"})}},
      {"y", "w", "c"}));
  for (const bool at_rest : {false, true}) EXPECT_LT(disagreement(*program, 0.5, 0.37e-3, at_rest), 2e-7);
}

TEST(AdvanceSampled, StartsFromRestBeforeTheFirstInstantAsTheIntegratorDoes) {
  const auto program = with_events(diagram({{"three", block("constant", {{"value", "3 V"}})},
                                            {"e", block("sum", {{"signs", "+-"}}, {"three", "x"})},
                                            {"c", pi("e")},
                                            {"drive", block("sum", {}, {"c", "three"})},
                                            {"w", block("play", {{"radius", "0.5 V"}}, {"drive"})},
                                            {"x", lag("w")}},
                                           {"x", "w"}));
  for (const bool at_rest : {false, true}) EXPECT_LT(disagreement(*program, 0.1, 0.5e-3, at_rest), 1e-7);
}

TEST(AdvanceSampled, SaysWhichBlockStandsInTheWay) {
  const auto why = [](Blocks blocks, const std::string& last) {
    blocks.insert(blocks.begin(),
                  {{"reference", sine()}, {"held", block("sample_hold", {{"period", "1 ms"}}, {"reference"})}});
    return why_not_exact(*with_events(diagram(blocks, {last, "held"})));
  };
  const auto expect = [](const std::string& text, std::initializer_list<const char*> parts) {
    for (const char* part : parts) EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  EXPECT_EQ(why({{"x", lag("held")}}, "x"), "");
  EXPECT_EQ(why({{"sum", block("sum", {}, {"held", "reference"})}}, "sum"), "");
  expect(why({{"sum", block("sum", {}, {"held", "reference"})}, {"x", lag("sum")}}, "x"),
         {"sine \"reference\"", "lag \"x\"", "function of time"});
  expect(why({{"w", block("play", {{"radius", "1 V"}}, {"reference"})}}, "w"), {"sine \"reference\"", "play \"w\""});
  expect(why({{"late", block("dead_time", {{"delay", "1 ms"}}, {"reference"})}}, "late"), {"dead_time \"late\""});
  EXPECT_EQ(why({{"law", thesis_bouc_wen("held")}}, "law"), "");
  expect(why({{"relay", block("test_relay", {{"on", "1 V"}, {"off", "-1 V"}, {"level", 1.0}}, {"held"})}}, "relay"),
         {"test_relay \"relay\"", "mode"});
  EXPECT_EQ(why({{"sum", block("sum", {}, {"held", "x"})},
                 {"w", block("play", {{"radius", "1 V"}}, {"sum"})},
                 {"x", lag("w")}},
                "x"),
            "");
  expect(why({{"sum", block("sum", {}, {"held", "late"})},
              {"w", block("play", {{"radius", "1 V"}}, {"sum"})},
              {"x", lag("w")},
              {"late", block("dead_time", {{"delay", "1 ms"}}, {"x"})}},
             "x"),
         {"dead_time \"late\"", "feedback loop"});
  const auto program = with_events(diagram({{"reference", sine()}, {"x", lag("reference")}}, {"x"}));
  EXPECT_NE(why_not_exact(*program).find("\"reference\""), std::string::npos);
}

TEST(AdvanceSampled, TheSameAdvanceGivesTheSameAgain) {
  // What an earlier run held and remembered is gone; the matrices stay.
  const auto program = with_events(diagram({{"reference", sine()},
                                            {"e", error_of("x")},
                                            {"c", pi("e")},
                                            {"w", block("play", {{"radius", "0.3 V"}}, {"c"})},
                                            {"late", block("dead_time", {{"delay", "0.4 ms"}}, {"w"})},
                                            {"x", lag("late")}},
                                           {"x"}));
  Advance advance(program, program->record_signals);
  const auto instants = grid(0, 0.1, 170);
  std::vector<std::vector<double>> first, second;
  advance(start(*program), instants, {.at_rest = false}, first);
  EXPECT_EQ(advance.samples(), 101);
  advance(start(*program), instants, {.at_rest = false}, second);
  EXPECT_EQ(first, second);
  EXPECT_EQ(advance.samples(), 101);
}

}  // namespace
}  // namespace hysteron
