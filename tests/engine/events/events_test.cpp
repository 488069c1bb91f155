// Sampled blocks, modes, and jumps as paths: closed forms, and laws that hold for every diagram.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/events/clocks.h"
#include "tests/engine/event_blocks.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

ProgramPointer with_events(const Diagram& d) { return compile(d, test::registry_with_events()); }

Traces run_to(const Program& program, double until, double every, Method method = Method::bdf, double rtol = 1e-8) {
  return simulate(program, start(program),
                  {.until = until, .every = every, .method = method, .relative_tolerance = rtol});
}

// --- clocks

TEST(Clocks, FindTheFractionThatADecimalNumberMeans) {
  const auto is = [](double x, std::int64_t n, std::int64_t d) {
    const auto f = nearest_fraction(x);
    EXPECT_EQ(f.n, n) << x;
    EXPECT_EQ(f.d, d) << x;
  };
  is(0, 0, 1);
  is(1e-4, 1, 10'000);
  is(0.02, 1, 50);
  is(1.0 / 48'000, 1, 48'000);
  is(3.3e-5, 33, 1'000'000);
  is(7, 7, 1);
}

TEST(Clocks, BlocksWithCommensuratePeriodsMeetForEver) {
  // 0.3 is not a multiple of 0.1 in doubles, and 44.1 kHz has no decimal period: counted in ticks they meet exactly.
  for (const double fast : {0.1, 1.0 / 44'100}) {
    const auto p = with_events(diagram({{"fast", block("test_counter", {{"period", Number{fast, "s"}}})},
                                        {"slow", block("test_counter", {{"period", Number{3 * fast, "s"}}})}},
                                       {"fast", "slow"}));
    auto run = start(*p);
    Clocks clocks(*p, run, 0);
    for (int k = 0; k < 300'000; ++k) {
      const auto due = clocks.take(clocks.next(), run);
      ASSERT_EQ(due.size(), k % 3 == 0 ? 2U : 1U) << "instant " << k << " of " << fast << " s";
    }
    EXPECT_EQ(run.hits[0], 299'999);
    EXPECT_EQ(run.hits[1], 99'999);
  }
}

TEST(Clocks, StartLateAtTheInstantsThatAreLeft) {
  const auto p =
      with_events(diagram({{"n", block("test_counter", {{"period", "0.1 s"}, {"offset", "0.05 s"}})}}, {"n"}));
  auto run = start(*p);
  Clocks clocks(*p, run, 0.35);
  EXPECT_DOUBLE_EQ(clocks.next(), 0.35);
  clocks.take(0.35, run);
  EXPECT_EQ(run.hits[0], 3);
}

// --- sampled blocks

TEST(Sampled, HoldsWhatItsInputWasAtTheInstant) {
  const auto p =
      with_events(diagram({{"u", block("sine", {{"amplitude", "1 V"}, {"frequency", "1 Hz"}})},
                           {"held", block("test_sampler", {{"period", "0.05 s"}, {"offset", "0.02 s"}}, {"u"})},
                           {"x", block("integrator", {}, {"held"})}},
                          {"held", "x"}));
  const auto traces = run_to(*p, 1, 0.005);
  double integral = 0, last = 0;
  for (std::size_t i = 0; i < traces.t.size(); ++i) {
    const double t = traces.t[i];
    const double k = std::floor((t - 0.02) / 0.05 + 1e-9);
    const double held = k < 0 ? 0.0 : std::sin(2 * M_PI * (0.02 + 0.05 * k));
    EXPECT_NEAR(traces.values[0][i], held, 1e-14) << t;
    // the value held at the instant counts from there on; the grid holds every instant
    if (i > 0) integral += last * (t - traces.t[i - 1]);
    last = held;
    EXPECT_NEAR(traces.values[1][i], integral, 1e-9) << t;  // ten times the tolerance
  }
}

TEST(Sampled, AFastBlockIsSeenInTheSameInstantIfItFeedsThroughAndLaterIfNot) {
  // Both files: the order in which blocks are written changes nothing.
  for (const bool reversed : {false, true}) {
    std::vector<std::pair<std::string, Node>> blocks{{"n", block("test_counter", {{"period", "1 s"}})},
                                                     {"sum", block("test_accumulator", {{"period", "1 s"}}, {"n"})},
                                                     {"through", block("test_sampler", {{"period", "2 s"}}, {"n"})},
                                                     {"late", block("test_sampler", {{"period", "2 s"}}, {"sum"})}};
    if (reversed) std::reverse(blocks.begin(), blocks.end());
    const auto p = with_events(diagram(blocks, {"n", "sum", "through", "late"}));
    const auto traces = run_to(*p, 5.5, 0.5);
    for (std::size_t i = 0; i < traces.t.size(); ++i) {
      const double k = std::floor(traces.t[i]), j = 2 * std::floor(k / 2);
      EXPECT_EQ(traces.values[0][i], k);
      EXPECT_EQ(traces.values[1][i], k * (k - 1) / 2);  // 0 + ... + (k - 1): what was seen until the instant before
      EXPECT_EQ(traces.values[2][i], j);
      EXPECT_EQ(traces.values[3][i], j * (j - 1) / 2);
    }
  }
}

TEST(Sampled, AControllerAroundALagIsTheRecursionOfItsZeroOrderHold) {
  // x' = (v - x)/tau, v = accumulator of r - x: x_{k+1} = a x_k + (1 - a) s_k, s_{k+1} = s_k + g (1 - x_k).
  const double tau = 0.3, period = 0.05, gain = 0.2, a = std::exp(-period / tau);
  const auto p = with_events(diagram({{"r", block("constant", {{"value", "1 V"}})},
                                      {"e", block("sum", {{"signs", "+-"}}, {"r", "x"})},
                                      {"s", block("test_accumulator", {{"gain", gain}, {"period", "0.05 s"}}, {"e"})},
                                      {"x", block("lag", {{"times", list({tau}, "s")}}, {"s"})}},
                                     {"x", "s"}));
  for (const auto method : {Method::bdf, Method::adams}) {
    const auto traces = run_to(*p, 3, 0.05, method);
    double x = 0, s = 0;
    for (std::size_t k = 0; k < traces.t.size(); ++k) {
      // The accumulator adds up the errors of up to sixty intervals, of one tolerance each.
      EXPECT_NEAR(traces.values[0][k], x, 3e-7) << k;
      EXPECT_NEAR(traces.values[1][k], s, 3e-7) << k;
      const double e = 1 - x;
      x = a * x + (1 - a) * s;
      s += gain * e;
    }
  }
}

TEST(Sampled, ALoopAtTheInstantsIsAnErrorWithTheUnitDelayAsCure) {
  try {
    with_events(diagram({{"r", block("constant", {{"value", "1 V"}})},
                         {"e", block("sum", {{"signs", "+-"}}, {"r", "k"})},
                         {"k", block("test_sampler", {{"period", "1 s"}}, {"e"})}},
                        {"k"}));
    FAIL() << "the sampler needs its own output at the instant";
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().code, "algebraic_loop");
    EXPECT_NE(e.problems.front().what.find("sampling instant"), std::string::npos);
    EXPECT_NE(e.problems.front().cure.find("delay"), std::string::npos);
  }
}

// --- jumps are paths

/// z behind a jump of Bouc-Wen's input by `du` (n = 1): dz/du = alpha - (beta +- gamma) z has one sign of z on each
/// branch, here only for paths on which z keeps its sign.
double after_jump(double z, double du, double alpha, double beta, double gamma) {
  const double direction = du > 0 ? 1 : -1;
  const double k = beta * direction + gamma * (z + direction * 1e-300 > 0 ? 1 : -1);  // dz = (alpha - k z) du
  return alpha / k + (z - alpha / k) * std::exp(-k * du);
}

TEST(JumpPaths, AStepIntoBoucWenIsTheRampInClosedForm) {
  const double z = after_jump(0, 4, 0.6187e-6, 0.2418, 0.0237);
  const double expected = 1.6126e-6 * 4 - z;
  for (const auto method : {Method::bdf, Method::adams})
    for (const double every : {0.5, 0.013, 0.25})  // whatever the output grid
      for (const bool behind : {false, true}) {    // blocks in between
        std::vector<std::pair<std::string, Node>> blocks{
            {"step", block("step", {{"after", behind ? "1 V" : "4 V"}, {"time", "0.5 s"}})}};
        if (behind) blocks.emplace_back("amplifier", block("gain", {{"gain", 4.0}}, {"step"}));
        blocks.emplace_back("y", thesis_bouc_wen(behind ? "amplifier" : "step"));
        const auto program = with_events(diagram(blocks, {"y"}));
        const auto traces = run_to(*program, 1, every, method);
        for (std::size_t i = 0; i < traces.t.size(); ++i)
          EXPECT_NEAR(trace(traces)[i], traces.t[i] < 0.5 ? 0.0 : expected, 1e-7 * expected) << traces.t[i];
        EXPECT_EQ(traces.statistics.paths, 1);
      }
}

TEST(JumpPaths, ThroughLawsInARowAndBentBlocksAreThoseOfAFastRamp) {
  // play behind Bouc-Wen behind the square of a jumping signal (down to zero and up again on the way), and a play in
  // front.
  const auto make = [](const std::string& source) {
    return diagram({{"front", block("play", {{"radius", "0.5 V"}}, {source})},
                    {"square", block("product", {}, {"front", "front"})},
                    {"scaled", block("gain", {{"gain", "1 1/V"}}, {"square"})},
                    {"law", thesis_bouc_wen("scaled")},
                    {"again", block("gain", {{"gain", "1 V/um"}}, {"law"})},
                    {"second", thesis_bouc_wen("again")},
                    {"behind", block("play", {{"radius", "0.3 um"}}, {"second"})}},
                   {"behind", "second"}, {{source, "V"}});
  };
  const std::vector<double> levels{0, 3, -2.5, 1, -3.5};
  const auto program = with_events(make("u"));
  auto held = start(*program), ramped = start(*program);
  std::vector<double> t, v, ramp_t, ramp_v;
  const double rise = 1e-3;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    t.push_back(static_cast<double>(k));
    v.push_back(levels[k]);
    if (k > 0) ramp_t.push_back(t.back()), ramp_v.push_back(levels[k - 1]);
    ramp_t.push_back(t.back() + (k > 0 ? rise : 0.0));
    ramp_v.push_back(levels[k]);
  }
  t.push_back(5);
  v.push_back(levels.back());
  bind_input(*program, held, "u", series(t, v, Between::hold));
  bind_input(*program, ramped, "u", series(ramp_t, ramp_v));
  const SimulateOptions options{
      .instants = {0.5, 1.5, 2.5, 3.5, 4.5}, .method = Method::adams, .relative_tolerance = 1e-7};
  const auto a = simulate(*program, held, options), b = simulate(*program, ramped, options);
  // The path commits memory in 64 pieces: at the turn of the square inside a piece the play misses up to its height,
  // (4 V/64)^2 of 16 V^2, and the ramp has its own tolerance.
  for (std::size_t s = 0; s < 2; ++s) EXPECT_LT(distance(a.values[s], b.values[s]), 3e-4 * largest(b.values[s]));
  EXPECT_EQ(a.statistics.paths, 4);
}

TEST(JumpPaths, ASampledDriveThroughPlayGivesTheMemoryOfItsSamples) {
  // Play needs no path where nothing bends in between: it is the recursion over the samples.
  const auto p = with_events(diagram({{"u", block("sine", {{"amplitude", "3 V"}, {"frequency", "1.3 Hz"}})},
                                      {"held", block("test_sampler", {{"period", "0.01 s"}}, {"u"})},
                                      {"y", block("play", {{"radius", "0.7 V"}}, {"held"})}},
                                     {"y"}));
  const auto traces = run_to(*p, 2, 0.01);
  double w = 0;
  for (std::size_t k = 0; k < traces.t.size(); ++k) {
    const double u = 3 * std::sin(2 * M_PI * 1.3 * 0.01 * static_cast<double>(k));
    w = std::max(u - 0.7, std::min(u + 0.7, w));
    EXPECT_NEAR(trace(traces)[k], w, 1e-12);
  }
}

TEST(JumpPaths, MemoryOnTheWayEndsAtTheValueBehindTheJumpToTheBit) {
  // Two plays in a row follow in pieces; from + (to - from) is often another number than `to`, and would be remembered.
  const auto p = with_events(diagram({{"u", block("sine", {{"amplitude", "3 V"}, {"frequency", "1.3 Hz"}})},
                                      {"held", block("test_sampler", {{"period", "0.01 s"}}, {"u"})},
                                      {"first", block("play", {{"radius", "0.1 V"}}, {"held"})},
                                      {"second", block("play", {{"radius", "0.2 V"}}, {"first"})}},
                                     {"held", "first", "second"}));
  const auto traces = run_to(*p, 2, 0.01);
  double first = 0, second = 0;
  for (std::size_t k = 0; k < traces.t.size(); ++k) {
    const double u = traces.values[0][k];
    first = std::max(u - 0.1, std::min(u + 0.1, first));
    second = std::max(first - 0.2, std::min(first + 0.2, second));
    EXPECT_EQ(traces.values[1][k], first) << k;
    EXPECT_EQ(traces.values[2][k], second) << k;
  }
}

TEST(JumpPaths, ALawThatIsNotRateIndependentRefusesAJump) {
  const auto make = [](const Node& between) {
    return diagram({{"step", block("step", {{"after", "1 V"}, {"time", "1 s"}})},
                    {"u", between},
                    {"x", block("test_rate_squared", {}, {"u"})}},
                   {"x"});
  };
  try {
    with_events(make(block("gain", {{"gain", 2.0}}, {"step"})));
    FAIL() << "its result would depend on how fast the jump is";
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().code, "jump_into_rate");
    EXPECT_NE(e.problems.front().what.find("step \"step\""), std::string::npos) << e.problems.front().what;
    EXPECT_NE(e.problems.front().cure.find("lag"), std::string::npos);
  }
  EXPECT_NO_THROW(with_events(make(block("lag", {{"times", list({0.01}, "s")}}, {"step"}))));
}

TEST(JumpPaths, AHeldInputIsRefusedWhenItIsBoundWhereItWouldReachSuchALaw) {
  const auto p = with_events(diagram({{"x", block("test_rate_squared", {}, {"u"})}}, {"x"}, {{"u", "V"}}));
  auto run = start(*p);
  EXPECT_NO_THROW(bind_input(*p, run, "u", series({0, 1}, {0, 1})));
  EXPECT_THROW(bind_input(*p, run, "u", series({0, 1}, {0, 1}, Between::hold)), Error);
}

// --- modes

TEST(Modes, ARelayAroundALagOscillatesWithThePeriodOfItsClosedForm) {
  // tau x' = -r - x with r = +-1, switching at x = +-h: half a period is tau ln((1 + h)/(1 - h)).
  const double h = 0.2, tau = 0.1;
  const auto p = with_events(
      diagram({{"minus", block("gain", {{"gain", -1.0}}, {"relay"})},
               {"x", block("lag", {{"times", list({tau}, "s")}}, {"minus"})},
               {"relay", block("test_relay", {{"on", "0.2 V"}, {"off", "-0.2 V"}, {"level", "1 V"}}, {"x"})}},
              {"x", "relay"}));
  const double half = tau * std::log((1 + h) / (1 - h)), first = -tau * std::log(1 - h);
  std::vector<double> instants;
  for (int k = 0; k < 200; ++k) instants.push_back(0.0103 * k);
  for (const auto method : {Method::bdf, Method::adams}) {
    const auto traces = simulate(*p, start(*p), {.instants = instants, .method = method, .relative_tolerance = 1e-9});
    for (std::size_t i = 0; i < instants.size(); ++i) {
      const double t = instants[i];
      double expected = 1 - std::exp(-t / tau);  // the relay starts below: x rises to +1
      if (t > first) {
        const double since = std::fmod(t - first, half), sign = std::fmod(t - first, 2 * half) < half ? 1 : -1;
        expected = sign * ((1 + h) * std::exp(-since / tau) - 1);
      }
      EXPECT_NEAR(traces.values[0][i], expected, 1e-7) << t;  // a hundred times the tolerance: switching times add up
    }
    EXPECT_EQ(traces.statistics.mode_changes.at(0).second, 1 + static_cast<long>((instants.back() - first) / half));
  }
}

TEST(Modes, ABallLosesItsEnergyAtEveryBounce) {
  const double g = 9.81, e = 0.8;
  const auto p = with_events(diagram(
      {{"push", block("constant", {{"value", "0 m/s^2"}})},
       {"ball", block("test_ball", {{"gravity", "9.81 m/s^2"}, {"restitution", e}, {"height", "1 m"}}, {"push"})}},
      {"ball"}));
  const auto traces = run_to(*p, 3, 0.001, Method::adams, 1e-9);
  for (std::size_t i = 0; i < traces.t.size(); ++i) {
    double t = traces.t[i], v = std::sqrt(2 * g), flight = std::sqrt(2 / g), expected = 0;
    if (t < flight) {
      expected = 1 - g * t * t / 2;
    } else {
      for (t -= flight, v *= e; t > 2 * v / g; v *= e) t -= 2 * v / g;
      expected = v * t - g * t * t / 2;
    }
    EXPECT_NEAR(trace(traces)[i], expected, 1e-6) << traces.t[i];
  }
}

TEST(Modes, TwoEventsAtOneInstantDoNotDependOnTheOrderOfBlocks) {
  // Two relays cross at one instant; a third sees the sum of both, which passes its threshold only if both have
  // switched.
  std::vector<Traces> results;
  for (const bool reversed : {false, true}) {
    std::vector<std::pair<std::string, Node>> blocks{
        {"u", block("sine", {{"amplitude", "1 V"}, {"frequency", "1 Hz"}})},
        {"a", block("test_relay", {{"on", "0.5 V"}, {"off", "-0.5 V"}, {"level", "1 V"}}, {"u"})},
        {"b", block("test_relay", {{"on", "0.5 V"}, {"off", "-0.5 V"}, {"level", "-1 V"}}, {"u"})},
        {"both", block("sum", {{"signs", "++"}}, {"a", "b"})},
        {"third", block("test_relay", {{"on", "0.3 V"}, {"off", "-0.3 V"}, {"level", "1 V"}}, {"both"})},
        {"x", block("integrator", {}, {"third"})}};
    if (reversed) std::reverse(blocks.begin(), blocks.end());
    results.push_back(run_to(*with_events(diagram(blocks, {"a", "b", "third", "x"})), 2, 0.01));
  }
  EXPECT_EQ(results[0].values, results[1].values);
  for (const double third : results[0].values[2])
    EXPECT_EQ(third, -1) << "a and b switch together: their sum stays zero, the third never sees one of them alone";
}

TEST(Modes, ChatteringIsReportedByName) {
  // A relay without hysteresis worth the name in feedback around an integrator.
  const auto p = with_events(
      diagram({{"minus", block("gain", {{"gain", -1.0}}, {"relay"})},
               {"x", block("integrator", {}, {"minus"})},
               {"relay", block("test_relay", {{"on", "1e-12 V s"}, {"off", "-1e-12 V s"}, {"level", "1 V"}}, {"x"})}},
              {"x"}));
  try {
    run_to(*p, 1, 0.01);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().code, "chattering");
    EXPECT_EQ(e.problems.front().path, "relay");
    EXPECT_NE(e.problems.front().cure.find("hysteresis"), std::string::npos);
  }
}

TEST(Modes, AJumpOfARelayIsAPathForTheLawBehindIt) {
  const double alpha = 0.6187e-6, beta = 0.2418, gamma = 0.0237;
  const auto p = with_events(
      diagram({{"u", block("sine", {{"amplitude", "1 V"}, {"frequency", "1 Hz"}})},
               {"relay", block("test_relay", {{"on", "0.5 V"}, {"off", "-0.5 V"}, {"level", "2 V"}}, {"u"})},
               {"y", thesis_bouc_wen("relay")}},
              {"y"}));
  const auto traces =
      simulate(*p, start(*p), {.instants = {0.01, 0.2}, .method = Method::bdf, .relative_tolerance = 1e-8});
  EXPECT_NEAR(trace(traces)[0], 1.6126e-6 * -2, 1e-13);  // z = 0 where the relay starts
  EXPECT_NEAR(trace(traces)[1], 1.6126e-6 * 2 - after_jump(0, 4, alpha, beta, gamma), 1e-12);
}

}  // namespace
}  // namespace hysteron
