// Nested diagrams that do not always run: what they hold, begin anew and sample, against closed forms, with every
// method.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "engine/analysis/linearize.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

using Blocks = std::vector<std::pair<std::string, Node>>;

/// A nested diagram with the input "u" and one output, its last block.
Node nested(const Blocks& blocks, const std::string& in, RunsWhen runs) {
  Diagram inner = diagram(blocks, {}, {{"u", ""}});
  inner.outputs["y"] = blocks.back().first;
  Node node;
  node.type = "diagram";
  node.nested = std::make_shared<const Diagram>(std::move(inner));
  node.in.push_back({"", in});
  node.runs = std::move(runs);
  return node;
}

RunsWhen enabled(const std::string& signal, bool resets_states = false, bool zeroes_outputs = false) {
  return {.enable = signal, .resets_states = resets_states, .zeroes_outputs = zeroes_outputs};
}
RunsWhen triggered(const std::string& signal, const std::string& edge = "rising") {
  return {.trigger = signal, .edge = edge};
}

Node constant(double value) { return block("constant", {{"value", value}}); }
/// True from `from` on for `duty` of each second.
Node on_from(double from, double duty) {
  return block("pulse", {{"high", 1.0}, {"period", "1 s"}, {"duty", duty}, {"time", Number{from, "s"}}});
}
/// A number that moves in a straight line, as a signal without corners.
Node rising(double slope) { return block("ramp", {{"slope", Number{slope, "1/s"}}}); }

const std::vector<Method> all_methods{Method::bdf, Method::adams, Method::runge_kutta, Method::rk4, Method::euler};

Traces run_with(const Program& program, Method method, double until, double every) {
  return simulate(program, start(program),
                  {.until = until, .every = every, .method = method, .relative_tolerance = 1e-9, .step = 1e-3});
}

void expect_trace(const Traces& traces, const std::function<double(double)>& expected, double tolerance,
                  const std::string& what, std::size_t signal = 0) {
  for (std::size_t i = 0; i < traces.t.size(); ++i)
    ASSERT_NEAR(traces.values[signal][i], expected(traces.t[i]), tolerance) << what << " at " << traces.t[i] << " s";
}

/// Seconds that on_from(0.35, 0.5) has been true until t.
double time_on(double t) {
  const double since = t - 0.35;
  if (since <= 0) return 0;
  return 0.5 * std::floor(since) + std::min(since - std::floor(since), 0.5);
}
bool is_on(double t) { return t >= 0.35 && t - 0.35 - std::floor(t - 0.35) < 0.5; }
double time_since_on(double t) { return t - 0.35 - std::floor(t - 0.35); }

TEST(Enabled, ASourceInsideRunsAtOnceWhereNoCornerSwitchesIt) {
  // The clock passes 1/2 at 0.5 s, within a step. What the source held before is no answer for the step that begins
  // there, though it was asked at that very instant: x = 3 (t - 0.5 s).
  const auto p = compiled(
      diagram({{"zero", constant(0)},
               {"one", block("constant", {{"value", "1 1/s"}})},
               {"clock", block("integrator", {}, {"one"})},
               {"part", nested({{"three", constant(3)}, {"y", block("sum", {{"signs", "++"}}, {"three", "u"})}}, "zero",
                               enabled("clock"))},
               {"x", block("integrator", {}, {"part"})}},
              {"x"}));
  for (const Method method : all_methods) {
    const auto traces =
        simulate(*p, start(*p), {.until = 1, .every = 0.1, .method = method, .relative_tolerance = 1e-9, .step = 0.1});
    // Straight lines are integrated exactly, the instant is found to 1e-9 s.
    expect_trace(
        traces, [](double t) { return 3 * std::max(0.0, t - 0.5); }, 1e-8, method_name(method));
  }
}

TEST(Enabled, AnIntegratorCountsTheTimeThatItIsOn) {
  const auto p = compiled(diagram({{"one", constant(1)},
                                   {"on", on_from(0.35, 0.5)},
                                   {"part", nested({{"time", block("integrator", {}, {"u"})}}, "one", enabled("on"))}},
                                  {"part"}));
  for (const Method method : all_methods)  // a constant is integrated exactly, but for rounding
    expect_trace(run_with(*p, method, 4, 0.013), time_on, 1e-9, method_name(method));
}

TEST(Enabled, StatesBeginAnewWhereThatIsAskedFor) {
  const auto p =
      compiled(diagram({{"one", constant(1)},
                        {"on", on_from(0.35, 0.5)},
                        {"part", nested({{"time", block("integrator", {{"initial", Number{2, "s"}}}, {"u"})}}, "one",
                                        enabled("on", true))},
                        {"silent", nested({{"time", block("integrator", {{"initial", Number{2, "s"}}}, {"u"})}}, "one",
                                          enabled("on", true, true))}},
                       {"part", "silent"}));
  for (const Method method : all_methods) {
    const auto traces = run_with(*p, method, 4, 0.013);
    const auto held = [](double t) {
      if (t < 0.35) return 0.0;  // it has not run yet
      return 2 + (is_on(t) ? time_since_on(t) : 0.5);
    };
    expect_trace(traces, held, 1e-9, method_name(method), 0);
    expect_trace(
        traces, [](double t) { return is_on(t) ? 2 + time_since_on(t) : 0.0; }, 1e-9, method_name(method), 1);
  }
}

TEST(Enabled, ALagStandsStillAndGoesOn) {
  // Enabled while a line lies above a level: located, for no corner of a source says when.
  const double T = 0.4, from = 0.31;
  const auto p = compiled(
      diagram({{"line", rising(1)},
               {"on", block("comparator", {{"level", from}, {"above", 1.0}, {"below", 0.0}}, {"line"})},
               {"off", block("comparator", {{"level", 0.83}, {"above", 0.0}, {"below", 1.0}}, {"line"})},
               {"both", block("logic", {{"is", "and"}}, {"on", "off"})},
               {"three", constant(3)},
               {"part", nested({{"lag", block("lag", {{"times", list({T}, "s")}}, {"u"})}}, "three", enabled("both"))}},
              {"part", "part.enabled"}));
  const auto expected = [&](double t) { return 3 * (1 - std::exp(-(std::clamp(t, from, 0.83) - from) / T)); };
  for (const Method method : {Method::bdf, Method::adams, Method::runge_kutta, Method::rk4}) {
    const auto traces = run_with(*p, method, 1.5, 0.011);
    expect_trace(traces, expected, 1e-7, method_name(method));  // relative tolerance 1e-9, a few hundred steps
    expect_trace(
        traces, [&](double t) { return t > from && t < 0.83 ? 1.0 : 0.0; }, 0, method_name(method), 1);
  }
}

TEST(Enabled, WhatHasNoStateHoldsItsLastValue) {
  const auto p = compiled(diagram(
      {{"line", rising(2)},
       {"on", on_from(0.35, 0.5)},
       {"held", nested({{"twice", block("gain", {{"gain", 2.0}}, {"u"})}}, "line", enabled("on"))},
       {"silent", nested({{"twice", block("gain", {{"gain", 2.0}}, {"u"})}}, "line", enabled("on", false, true))}},
      {"held", "silent"}));
  for (const Method method : all_methods) {
    const auto traces = run_with(*p, method, 3, 0.013);
    const auto held = [](double t) {
      if (t < 0.35) return 0.0;
      return 4 * (is_on(t) ? t : t - time_since_on(t) + 0.5);
    };
    expect_trace(traces, held, 1e-9, method_name(method), 0);
    expect_trace(
        traces, [](double t) { return is_on(t) ? 4 * t : 0.0; }, 1e-9, method_name(method), 1);
  }
}

TEST(Enabled, NothingIsSampledWhileItIsOff) {
  // Sums its samples of one, every 0.05 s: at 0.35 s, where it is switched on, it samples; at 0.85 s, where it is
  // switched off, it does not.
  const Node sum = block("discrete_integrator", {{"rule", "backward"}, {"period", "0.05 s"}}, {"u"});
  const auto p = compiled(diagram({{"one", constant(1)},
                                   {"on", on_from(0.35, 0.5)},
                                   {"part", nested({{"sum", sum}}, "one", enabled("on"))},
                                   {"anew", nested({{"sum", sum}}, "one", enabled("on", true, true))}},
                                  {"part", "anew"}));
  const auto samples = [](double t) { return std::floor(std::min(time_since_on(t), 0.46) / 0.05 + 1e-9) + 1; };
  for (const Method method : all_methods) {
    const auto traces = run_with(*p, method, 3, 0.013);
    expect_trace(
        traces, [&](double t) { return t < 0.35 ? 0.0 : 0.05 * (10 * std::floor(t - 0.35) + samples(t)); }, 1e-12,
        method_name(method), 0);
    expect_trace(
        traces, [&](double t) { return is_on(t) ? 0.05 * samples(t) : 0.0; }, 1e-12, method_name(method), 1);
  }
}

TEST(Enabled, ASampleThatSwitchesIsInForceAtItsOwnInstant) {
  // What enables is itself sampled: at 0.4 s it becomes true, at 0.7 s false.
  const Node sum = block("discrete_integrator", {{"rule", "backward"}, {"period", "0.1 s"}}, {"u"});
  const auto p = compiled(
      diagram({{"one", constant(1)},
               {"window", block("pulse", {{"high", 1.0}, {"period", "10 s"}, {"duty", 0.03}, {"time", "0.35 s"}})},
               {"on", block("sample_hold", {{"period", "0.1 s"}}, {"window"})},
               {"part", nested({{"sum", sum}}, "one", enabled("on"))},
               {"behind", block("sample_hold", {{"period", "0.1 s"}}, {"part"})}},
              {"part", "behind"}));
  const auto expected = [](double t) { return 0.1 * std::clamp(std::floor(t / 0.1 + 1e-9) - 3, 0.0, 3.0); };
  for (const Method method : all_methods) {
    const auto traces = run_with(*p, method, 1, 0.1 / 3);
    expect_trace(traces, expected, 1e-12, method_name(method), 0);
    expect_trace(traces, expected, 1e-12, method_name(method), 1);  // it sees the sample of the same instant
  }
}

TEST(Enabled, MemoryDoesNotSeeWhatHappensMeanwhile) {
  // Up to 3 while on; back to -3 while off; on again at -3 + ...: the play then meets its other side.
  const auto p = compiled(diagram(
      {{"way", block("time_table", {{"times", list({0, 1, 2, 3, 4}, "s")}, {"values", list({0, 3, -3, 2, 2})}})},
       {"on", block("pulse", {{"low", 1.0}, {"high", 0.0}, {"period", "10 s"}, {"duty", 0.15}, {"time", "1 s"}})},
       {"part", nested({{"play", block("play", {{"radius", 0.5}}, {"u"})}}, "way", enabled("on"))}},
      {"part"}));
  const auto expected = [](double t) {
    if (t <= 1) return std::max(0.0, 3 * t - 0.5);
    if (t < 2.5) return 2.5;                                                           // off: the way to -3 is not seen
    return std::min(2.5, 0.0) + std::max(0.0, std::min(-3 + 5 * (t - 2), 2.0) - 0.5);  // -0.5 at 2.5 s is 0.5 below 0
  };
  for (const Method method : {Method::bdf, Method::runge_kutta, Method::rk4}) {
    const auto traces = run_with(*p, method, 4, 0.05);
    expect_trace(traces, expected, 1e-6, method_name(method));
  }
}

TEST(Enabled, OneInsideTheOtherRunsWhileBothAre) {
  const auto inner = [](RunsWhen runs) {
    Diagram d = diagram(
        {{"on", on_from(0, 0.25)}, {"deep", nested({{"time", block("integrator", {}, {"u"})}}, "u", std::move(runs))}},
        {}, {{"u", ""}});
    d.outputs["y"] = "deep";
    return std::make_shared<const Diagram>(std::move(d));
  };
  Node outer;
  outer.type = "diagram";
  outer.in.push_back({"", "one"});
  outer.nested = inner(enabled("on"));
  outer.runs = enabled("long", true, true);
  // The outer one runs from 2 s on for 5 s of each 10 s.
  const auto p =
      compiled(diagram({{"one", constant(1)},
                        {"long", block("pulse", {{"high", 1.0}, {"period", "10 s"}, {"duty", 0.5}, {"time", "2 s"}})},
                        {"part", outer}},
                       {"part", "part/deep/time"}));
  const auto expected = [](double t) {
    const double since = t - 2 - 10 * std::floor((t - 2) / 10);
    if (t < 2 || since >= 5) return 0.0;
    return 0.25 * std::floor(since) + std::min(since - std::floor(since), 0.25);
  };
  for (const Method method : all_methods) {
    const auto traces = run_with(*p, method, 16, 0.043);
    expect_trace(traces, expected, 1e-9, method_name(method), 0);
    expect_trace(traces, expected, 1e-9, method_name(method), 1);
  }
}

TEST(Enabled, JumpsOfItsOutputsArePathsForWhatRemembersBehindIt) {
  // Zero while it is off: the play behind follows the jump from 3 to 0 and stays half a unit above.
  const auto p = compiled(
      diagram({{"three", constant(3)},
               {"on", block("pulse", {{"high", 1.0}, {"period", "10 s"}, {"duty", 0.1}, {"time", "0.5 s"}})},
               {"part", nested({{"same", block("gain", {{"gain", 1.0}}, {"u"})}}, "three", enabled("on", false, true))},
               {"play", block("play", {{"radius", 0.5}}, {"part"})},
               {"lag", block("lag", {{"times", list({0.1}, "s")}}, {"play"})}},
              {"play", "lag"}));
  for (const Method method : all_methods)
    expect_trace(
        run_with(*p, method, 3, 0.05), [](double t) { return t < 0.5   ? 0.0
                                                             : t < 1.5 ? 2.5
                                                                       : 0.5; }, 1e-9,
        method_name(method));
}

TEST(Enabled, TheEquilibriumAtTheStartIsOfWhatRunsThere) {
  const Node lag = block("lag", {{"times", list({0.1}, "s")}}, {"u"});
  Diagram d = diagram({{"three", constant(3)},
                       {"yes", constant(1)},
                       {"no", constant(0)},
                       {"runs", nested({{"lag", lag}}, "three", enabled("yes"))},
                       {"stands", nested({{"lag", lag}}, "three", enabled("no"))}},
                      {"runs", "stands"});
  d.simulate.start = "steady";
  const auto p = compiled(d);
  auto options = simulate_options(*p, {.until = 1, .every = 0.1});
  const auto traces = simulate(*p, start(*p), options);
  expect_trace(
      traces, [](double) { return 3.0; }, 1e-6, "runs", 0);
  expect_trace(
      traces, [](double) { return 0.0; }, 0, "stands", 1);
}

/// Slopes of the recorded signals with respect to one parameter.
Traces slopes_of(const Program& program, const std::string& parameter) {
  int index = -1;
  for (std::size_t i = 0; i < program.parameters.size(); ++i)
    if (program.parameters[i].path == parameter) index = static_cast<int>(i);
  return simulate(
      program, start(program),
      {.until = 1, .every = 0.05, .method = Method::bdf, .relative_tolerance = 1e-8, .slopes_for = {index}});
}

TEST(Enabled, SlopesPassTheInstantsAtWhichItIsSwitched) {
  // The line crosses 1/2 at 0.5/slope = 0.25 s: y = t - 0.5/slope from there on, dy/dslope = 0.5/slope^2 = 1/8,
  // known to the relative step of the runs beside (1e-5), since the slope of the guard in time is taken from one of
  // them.
  const auto p =
      compiled(diagram({{"line", rising(2)},
                        {"one", constant(1)},
                        {"part", nested({{"time", block("integrator", {}, {"u"})}}, "one", enabled("line"))},
                        {"anew", nested({{"time", block("integrator", {}, {"u"})}}, "one", enabled("line", true))}},
                       {"part", "anew"}));
  const auto along_slope = slopes_of(*p, "line.slope");
  for (std::size_t s = 0; s < 2; ++s)
    for (std::size_t i = 0; i < along_slope.t.size(); ++i)
      if (std::abs(along_slope.t[i] - 0.25) > 0.01) {
        EXPECT_NEAR(along_slope.slopes[0][s][i], along_slope.t[i] > 0.25 ? 0.125 : 0.0, 2e-6) << along_slope.t[i];
      }
}

TEST(Enabled, SlopesAreRefusedWhereTheInstantIsOneOfAJump) {
  const Blocks line_and_one{{"line", rising(2)},
                            {"on", block("comparator", {{"level", 1.0}, {"above", 1.0}, {"below", 0.0}}, {"line"})},
                            {"one", constant(1)}};
  auto blocks = line_and_one;
  blocks.emplace_back("part", nested({{"time", block("integrator", {}, {"u"})}}, "one", enabled("on")));
  const auto p = compiled(diagram(blocks, {"part"}));
  EXPECT_THROW(slopes_of(*p, "on.level"), Error);
  // The size of what is integrated shifts no instant: dy/dvalue = the time that it has been on.
  const auto along_value = slopes_of(*p, "one.value");
  for (std::size_t i = 0; i < along_value.t.size(); ++i)
    EXPECT_NEAR(along_value.slopes[0][0][i], std::max(0.0, along_value.t[i] - 0.5), 1e-6) << along_value.t[i];
  blocks = line_and_one;
  blocks.emplace_back("part",
                      nested({{"held", block("sample_hold", {{"period", "0.1 s"}}, {"u"})}}, "one", enabled("on")));
  EXPECT_THROW(slopes_of(*compiled(diagram(blocks, {"part"})), "one.value"), Error);
}

TEST(Enabled, NoSmallMotionPassesWhatIsOff) {
  const auto p = compiled(
      diagram({{"drive", constant(1)},
               {"no", constant(0)},
               {"part", nested({{"lag", block("lag", {{"times", list({0.1}, "s")}}, {"u"})}}, "drive", enabled("no"))}},
              {"part"}));
  const LinearizeOptions way{.from = {p->signal("drive")}, .to = {p->signal("part/lag")}};
  EXPECT_EQ(blocks_that_cut(*p, start(*p), way), std::vector<int>{p->block_index("part/lag")});
  EXPECT_EQ(linearize(*p, start(*p), way).on_the_way().states, 0);
  auto on = start(*p);
  set_parameter(*p, on, "no.value", 1);
  const auto there = simulate(*p, on, {.until = 1, .every = 0.5, .method = Method::bdf}).end.value();
  EXPECT_TRUE(blocks_that_cut(*p, there, way).empty());
  EXPECT_EQ(linearize(*p, there, way).on_the_way().poles().size(), 1U);
}

TEST(Triggered, AStaircaseOfTheValuesAtTheEdges) {
  // Edges of a wave of period 1 s, true for the first half: rising at 0.25, 1.25 ..., falling at 0.75, 1.75 ...
  struct Case {
    const char* edge;
    double first, every;
  };
  for (const auto& [edge, first, every] :
       {Case{"rising", 0.25, 1}, Case{"falling", 0.75, 1}, Case{"either", 0.25, 0.5}}) {
    const auto p = compiled(diagram(
        {{"line", rising(1)},
         {"clock", on_from(0.25, 0.5)},
         {"part", nested({{"twice", block("gain", {{"gain", 2.0}}, {"u"})}}, "line", triggered("clock", edge))}},
        {"part"}));
    const auto expected = [first = first, every = every](double t) {
      return t < first ? 0.0 : 2 * (first + every * std::floor((t - first) / every + 1e-9));
    };
    for (const Method method : all_methods)
      expect_trace(run_with(*p, method, 4, 0.013), expected, 1e-9, method_name(method) + " " + edge);
  }
}

TEST(Triggered, SampledBlocksRunOncePerEdge) {
  // The edges are located: a sine that passes 1/2 upwards. Of the two sums one has a period that no clock would meet.
  const double f = 3;
  const auto p = compiled(
      diagram({{"one", constant(1)},
               {"wave", block("sine", {{"amplitude", 1.0}, {"frequency", Number{f, "Hz"}}})},
               {"part", nested({{"sum", block("discrete_integrator",
                                              {{"rule", "backward"}, {"period", Number{std::sqrt(2.0), "s"}}}, {"u"})},
                                {"late", block("delay_line", {{"samples", 1.0}, {"period", "1 s"}}, {"sum"})},
                                {"both", block("sum", {}, {"sum", "late"})}},
                               "one", triggered("wave"))},
               {"clocked", block("sample_hold", {{"period", "0.05 s"}}, {"part"})}},
              {"part", "part/sum", "part/late", "clocked"}));
  const double first = std::asin(0.5) / (2 * std::numbers::pi * f);
  const auto edges = [&](double t) { return t < first ? 0.0 : std::floor((t - first) * f) + 1; };
  const double T = std::sqrt(2.0);
  for (const Method method : all_methods) {
    const auto traces = run_with(*p, method, 2, 0.0171);
    expect_trace(
        traces, [&](double t) { return T * edges(t); }, 1e-12, method_name(method), 1);
    expect_trace(
        traces, [&](double t) { return T * std::max(edges(t) - 1, 0.0); }, 1e-12, method_name(method), 2);
    expect_trace(
        traces, [&](double t) { return T * (edges(t) + std::max(edges(t) - 1, 0.0)); }, 1e-12, method_name(method), 0);
  }
}

TEST(Triggered, ASampleThatTriggersIsInForceAtItsOwnInstant) {
  const auto p = compiled(diagram(
      {{"line", rising(1)},
       {"window", on_from(0.35, 0.5)},
       {"clock", block("sample_hold", {{"period", "0.1 s"}}, {"window"})},
       {"part", nested({{"held", block("sample_hold", {{"period", "7 s"}}, {"u"})}}, "line", triggered("clock"))},
       {"behind", block("sample_hold", {{"period", "0.1 s"}}, {"part"})}},
      {"part", "behind"}));
  const auto expected = [](double t) { return t < 0.4 - 1e-9 ? 0.0 : 0.4 + std::floor(t - 0.4 + 1e-9); };
  for (const Method method : all_methods) {
    const auto traces = run_with(*p, method, 3, 0.05);
    expect_trace(traces, expected, 1e-9, method_name(method), 0);
    expect_trace(traces, expected, 1e-9, method_name(method), 1);
  }
}

TEST(Triggered, EdgesCountWhileItIsEnabled) {
  RunsWhen runs = triggered("clock");
  runs.enable = "on";
  runs.zeroes_outputs = true;
  const Node sum = block("discrete_integrator", {{"rule", "backward"}, {"period", "1 s"}}, {"u"});
  const auto p =
      compiled(diagram({{"one", constant(1)},
                        {"clock", block("pulse", {{"high", 1.0}, {"period", "0.1 s"}, {"time", "0.05 s"}})},
                        {"on", block("pulse", {{"high", 1.0}, {"period", "10 s"}, {"duty", 0.1}, {"time", "0.5 s"}})},
                        {"part", nested({{"sum", sum}}, "one", runs)}},
                       {"part"}));
  const auto expected = [](double t) {  // edges at 0.55, 0.65 ... 1.45
    return t < 0.55 - 1e-9 || t >= 1.5 - 1e-9 ? 0.0 : std::floor((t - 0.55) / 0.1 + 1e-6) + 1;
  };
  for (const Method method : all_methods)
    expect_trace(run_with(*p, method, 2, 0.013), expected, 1e-12, method_name(method));
}

TEST(Triggered, WhatSwitchesInsideDoesSoBeforeItStops) {
  // A relay inside: it is asked at the edges only.
  const auto p = compiled(diagram(
      {{"wave", block("sine", {{"amplitude", 2.0}, {"frequency", "0.5 Hz"}})},
       {"clock", block("pulse", {{"high", 1.0}, {"period", "0.3 s"}, {"time", "0.1 s"}})},
       {"part",
        nested({{"relay",
                 block("relay", {{"on_at", 1.0}, {"off_at", -1.0}, {"on_value", 5.0}, {"off_value", -5.0}}, {"u"})}},
               "wave", triggered("clock"))}},
      {"part"}));
  const auto expected = [](double t) {
    if (t < 0.1 - 1e-9) return 0.0;
    double state = -5;
    for (double edge = 0.1; edge <= t + 1e-9; edge += 0.3) {
      const double u = 2 * std::sin(std::numbers::pi * edge);
      state = u >= 1 ? 5 : u <= -1 ? -5 : state;
    }
    return state;
  };
  for (const Method method : all_methods)
    expect_trace(run_with(*p, method, 4, 0.013), expected, 0, method_name(method));
}

void expect_refused(const Blocks& inside, const RunsWhen& runs, const std::string& name) {
  try {
    compiled(diagram({{"line", rising(1)}, {"on", constant(1)}, {"part", nested(inside, "line", runs)}}, {"part"}));
    FAIL() << name << " was not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.problems.front().code, "cannot_be_switched") << error.what();
    EXPECT_NE(error.problems.front().what.find("\"part/" + name + "\""), std::string::npos) << error.what();
    EXPECT_FALSE(error.problems.front().cure.empty());
  }
}

TEST(Enabled, WhatNeedsAllOfTimeIsRefusedByName) {
  expect_refused({{"late", block("dead_time", {{"delay", "1 ms"}}, {"u"})}}, enabled("on"), "late");
  expect_refused({{"law", block("bouc_wen", {{"alpha", 0.6}, {"beta", 0.2}, {"gamma", 0.02}, {"d_p", 1.0}}, {"u"})}},
                 enabled("on"), "law");
  expect_refused({{"time", block("integrator", {}, {"u"})}}, triggered("on"), "time");
  const Node deep = nested({{"same", block("gain", {{"gain", 1.0}}, {"u"})}}, "u", enabled("u"));
  expect_refused({{"deep", deep}}, triggered("on"), "deep");
}

TEST(Enabled, TheSignalThatEnablesIsAWireLikeOthers) {
  const Node same = block("gain", {{"gain", 1.0}}, {"u"});
  Diagram d = diagram({{"line", rising(1)}, {"part", nested({{"same", same}}, "line", enabled("lime"))}}, {"part"});
  try {
    compiled(d);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.problems.front().code, "unknown_signal");
    EXPECT_EQ(error.problems.front().path, "/blocks/part/enable");
  }
  d.blocks["volt"] = block("constant", {{"value", "1 V"}});
  d.blocks["part"].runs->enable = "volt";
  EXPECT_THROW(compiled(d), Error);  // true and false are plain numbers
}

}  // namespace
}  // namespace hysteron
