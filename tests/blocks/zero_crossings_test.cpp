// What sources in closed form switch: nothing is stepped over, whatever the phase, the end, the output step and the
// method. Against integrals in closed form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/blocks/samples.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using tools::block;

std::string number(double value, const std::string& unit = "") {
  std::string text = fmt::format("{:.17g}", value);
  return unit.empty() ? text : text + " " + unit;
}
Node sine(double amplitude, double frequency, double phase = 0, double offset = 0) {
  return block("sine", {{"amplitude", amplitude},
                        {"offset", offset},
                        {"frequency", number(frequency, "Hz")},
                        {"phase", number(phase, "rad")}});
}
Traces simulated(const Diagram& d, SimulateOptions options) {
  const auto program = tools::compiled(d);
  return simulate(*program, start(*program), options);
}
Traces simulated(const Diagram& d, double until, Method method = Method::automatic, double every = 0) {
  SimulateOptions options;
  options.until = until;
  options.every = every;
  options.method = method;
  options.step = 1e-3;
  return simulated(d, options);
}

/// Time in [0, until] in which sin(2 pi f t + phase) is above the level: from asin(level) to pi - asin(level), each
/// turn. Counted by the whole turns and what is left of them.
double time_above(double level, double f, double phase, double until) {
  const double begin = std::asin(level) / (2 * M_PI), end = 0.5 - begin;  // in turns
  const auto up_to = [&](double turns) {
    const double whole = std::floor(turns - begin);
    return whole * (end - begin) + std::min(turns - begin - whole, end - begin);
  };
  const double from = phase / (2 * M_PI);
  return (up_to(from + f * until) - up_to(from)) / f;
}

// Tolerances below: ten times the relative tolerance of 1e-6, of the largest value.

TEST(ZeroCrossings, ARelayBehindASineSwitchesAtEveryPhaseEndAndMethod) {
  // On at the level and off again at its opposite: half a turn, whatever the level. The integral of the output.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> phases(0, 2 * M_PI), levels(0.05, 0.999), ends(0.7, 3.3);
  for (int i = 0; i < 40; ++i) {
    const double level = levels(random), phase = phases(random), until = ends(random);
    const auto d = tools::diagram(
        {{"s", sine(1, 1, phase)},
         {"r",
          block("relay", {{"on_at", level}, {"off_at", -level}, {"on_value", "1 1/s"}, {"off_value", "0 1/s"}}, {"s"})},
         {"i", block("integrator", {}, {"r"})}},
        {"i"});
    // Switching on at sin = level (or at once, where it is above), off at sin = -level falling.
    double on = 0, t = 0;
    bool is_on = std::sin(phase) >= level;
    const auto next = [&](double turn) {  // first time behind t at which the phase is so many turns, modulo one
      return t + std::fmod(2 + turn - std::fmod(phase / (2 * M_PI) + t, 1.0), 1.0);
    };
    while (t < until) {
      const double change = next(is_on ? 0.5 + std::asin(level) / (2 * M_PI) : std::asin(level) / (2 * M_PI));
      if (is_on) on += std::min(change, until) - t;
      t = std::max(change, t + 1e-12);
      is_on = !is_on;
    }
    for (const Method method : {Method::bdf, Method::adams, Method::runge_kutta, Method::rk4, Method::euler})
      for (const double every : {0.0, until / 3}) {
        const double got = simulated(d, until, method, every).values[0].back();
        EXPECT_NEAR(got, on, 1e-5) << "level " << level << ", phase " << phase << ", until " << until << ", "
                                   << method_name(method) << ", every " << every;
      }
  }
}

TEST(ZeroCrossings, ADeadZoneThatASineJustLeavesIsIntegrated) {
  // u - sat(u) with u = sin(w t + phase) over whole turns: cos of the angle at which it leaves, less what is cut off:
  // the integral of its positive part over a turn is (2 cos(a) - level (pi - 2 a)) / w with a = asin(level).
  std::mt19937 random(2);
  std::uniform_real_distribution<double> phases(0, 2 * M_PI), levels(0.3, 0.995), frequencies(0.3, 5);
  for (int i = 0; i < 30; ++i) {
    const double level = levels(random), phase = phases(random), f = frequencies(random);
    const auto d = tools::diagram({{"u", sine(1, f, phase)},
                                   {"s", block("saturation", {{"lower", -level}, {"upper", level}}, {"u"})},
                                   {"d", block("sum", {{"signs", "+-"}}, {"u", "s"})},
                                   {"p", block("rectifier", {{"mix", 0.5}}, {"d"})},
                                   {"i", block("integrator", {}, {"p"})}},
                                  {"i"});
    const double a = std::asin(level), turn = (2 * std::cos(a) - level * (M_PI - 2 * a)) / (2 * M_PI * f);
    for (const Method method : {Method::bdf, Method::adams, Method::runge_kutta})
      EXPECT_NEAR(simulated(d, 4 / f, method).values[0].back(), 4 * turn, 1e-5 * 4 * turn + 1e-6 / f)
          << "level " << level << ", phase " << phase << ", " << f << " Hz, " << method_name(method);
  }
}

TEST(ZeroCrossings, AHalfWaveIsIntegratedBehindEverySource) {
  // Of a sine above a level over whole turns, as before; of a multisine by a fine sum of its own values.
  const auto half_wave = [](const Node& source) {
    return tools::diagram(
        {{"u", source}, {"p", block("rectifier", {{"mix", 0.5}}, {"u"})}, {"q", block("integrator", {}, {"p"})}},
        {"u", "q"});
  };
  const std::vector<Node> sources{
      sine(0.5, 3.4, 0, -0.15), block("triangle", {{"amplitude", 1.0}, {"offset", -0.97}, {"frequency", "3 Hz"}}),
      block("chirp", {{"amplitude", 1.0}, {"offset", -0.95}, {"from", "1 Hz"}, {"to", "20 Hz"}, {"duration", "2 s"}}),
      block("multisine", {{"rms", 1.0},
                          {"offset", -1.9},
                          {"lowest", "1 Hz"},
                          {"highest", "9 Hz"},
                          {"spacing", "1 Hz"},
                          {"seed", 5.0}})};
  for (const auto& source : sources) {
    const auto fine = simulated(half_wave(source), 2, Method::bdf, 1e-5);
    double sum = 0;  // trapezoids: kinks cost (slope step)^2/8 each, some 1e-8
    for (std::size_t k = 1; k < fine.t.size(); ++k)
      sum += 5e-6 * (std::max(0.0, fine.values[0][k - 1]) + std::max(0.0, fine.values[0][k]));
    EXPECT_GT(sum, 1e-4) << source.type;
    for (const Method method : {Method::bdf, Method::adams, Method::runge_kutta})
      EXPECT_NEAR(simulated(half_wave(source), 2, method).values[1].back(), sum, 1e-5 * sum + 2e-7) << source.type;
  }
}

TEST(ZeroCrossings, APowerOfASineAboveALevelIsIntegrated) {
  // The fourth power turns four times as often as its factors. Against midpoints of 10 us, whose kinks cost some 1e-9.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> phases(0, 2 * M_PI), levels(0.3, 0.97);
  for (int i = 0; i < 10; ++i) {
    const double level = levels(random), phase = phases(random);
    const auto d = tools::diagram({{"s", sine(1, 1.5, phase)},
                                   {"p", block("product", {}, {"s", "s"})},
                                   {"q", block("product", {}, {"p", "p"})},
                                   {"l", block("saturation", {{"lower", -1.0}, {"upper", level}}, {"q"})},
                                   {"d", block("sum", {{"signs", "+-"}}, {"q", "l"})},
                                   {"i", block("integrator", {}, {"d"})}},
                                  {"i"});
    double sum = 0;
    for (int k = 0; k < 200000; ++k)
      sum += 1e-5 * std::max(0.0, std::pow(std::sin(2 * M_PI * 1.5 * (k + 0.5) * 1e-5 + phase), 4) - level);
    for (const Method method : {Method::bdf, Method::adams, Method::runge_kutta})
      EXPECT_NEAR(simulated(d, 2, method).values[0].back(), sum, 1e-5) << level << " " << method_name(method);
  }
}

TEST(ZeroCrossings, ARelayBehindACornerSeesItsTip) {
  // |sin| falls below 0.02 for 13 ms around each zero: off there, on at 0.9, each half turn.
  const auto d = tools::diagram(
      {{"s", sine(1, 0.5)},
       {"a", block("rectifier", {{"mix", 1.0}}, {"s"})},
       {"r", block("relay", {{"on_at", 0.9}, {"off_at", 0.02}, {"on_value", "1 1/s"}, {"off_value", "0 1/s"}}, {"a"})},
       {"i", block("integrator", {}, {"r"})}},
      {"i"});
  const double on = (M_PI - std::asin(0.02) - std::asin(0.9)) / M_PI;
  for (const Method method : {Method::bdf, Method::adams, Method::runge_kutta})
    EXPECT_NEAR(simulated(d, 5, method).values[0].back(), 5 * on, 1e-5) << method_name(method);
}

TEST(ZeroCrossings, ARoundedSineIsIntegrated) {
  // round(1.2 sin) is 1 where the sine is above 1/2.4, and -1 opposite: the integral of its positive part.
  const auto d = tools::diagram({{"u", sine(1.2, 2, 0.3)},
                                 {"r", block("rounding", {{"step", 1.0}}, {"u"})},
                                 {"p", block("rectifier", {{"mix", 0.5}}, {"r"})},
                                 {"i", block("integrator", {}, {"p"})}},
                                {"i"});
  EXPECT_NEAR(simulated(d, 3).values[0].back(), time_above(0.5 / 1.2, 2, 0.3, 3), 1e-5);
}

TEST(ZeroCrossings, ARoundingAboutALevelThatIsNotZeroIsIntegrated) {
  // Levels ..., -0.75, 0.25, 1.25: 1.25 above 0.75, -0.75 below -0.25, else 0.25. What is above 0.25 is one where
  // 1.2 sin is above 0.75.
  const auto d = tools::diagram({{"u", sine(1.2, 2, 0.3)},
                                 {"r", block("rounding", {{"step", 1.0}, {"zero", 0.25}}, {"u"})},
                                 {"above", block("calibration", {{"offset", -0.25}}, {"r"})},
                                 {"p", block("rectifier", {{"mix", 0.5}}, {"above"})},
                                 {"i", block("integrator", {}, {"p"})}},
                                {"i"});
  EXPECT_NEAR(simulated(d, 3).values[0].back(), time_above(0.75 / 1.2, 2, 0.3, 3), 1e-5);
}

TEST(ZeroCrossings, ARoundingThatIsOnlySampledEndsNoStep) {
  // Between samples nothing hangs on it: 80 000 levels are passed within these 2 s, 2 000 samples are taken.
  const auto steps = [](const Node& encoder) {
    const auto d = tools::diagram({{"u", sine(5, 2)},
                                   {"x", block("lag", {{"times", number(10, "ms")}}, {"u"})},
                                   {"encoder", encoder},
                                   {"k", block("sample_hold", {{"period", "1 ms"}}, {"encoder"})},
                                   {"i", block("integrator", {}, {"k"})}},
                                  {"i"});
    return simulated(d, 2).statistics.steps;
  };
  EXPECT_LT(steps(block("rounding", {{"step", 1e-3}}, {"x"})), 2 * steps(block("gain", {{"gain", 1.0}}, {"x"})));
}

TEST(ZeroCrossings, PowersInALoopThroughAStateShortenNoStep) {
  // A loop has no highest harmonic. A step of a hundredth of the period is usual at this tolerance: 300 steps.
  const auto d = tools::diagram({{"u", sine(1, 1)},
                                 {"x2", block("product", {}, {"x", "x"})},
                                 {"x4", block("product", {}, {"x2", "x2"})},
                                 {"x8", block("product", {}, {"x4", "x4"})},
                                 {"x9", block("product", {}, {"x8", "x"})},
                                 {"e", block("sum", {{"signs", "+-"}}, {"u", "x9"})},
                                 {"x", block("lag", {{"times", number(100, "ms")}}, {"e"})},
                                 {"s", block("saturation", {{"lower", -0.1}, {"upper", 0.1}}, {"x"})},
                                 {"y", block("integrator", {}, {"s"})}},
                                {"y"});
  EXPECT_LT(simulated(d, 3).statistics.steps, 1000);
}

TEST(ZeroCrossings, AMassBehindABreakawayThatASineJustPassesSlides) {
  // Largest speed of the mass, by an independent integration with fine fixed steps: 0.06013 m/s.
  const auto d = tools::diagram(
      {{"f", block("sine", {{"amplitude", "1.175 N"}, {"frequency", "1 Hz"}})},
       {"m", block("mass_with_friction", {{"mass", "1 kg"}, {"coulomb", "0.8 N"}, {"breakaway", "1 N"}}, {"f"})}},
      {"m.velocity"});
  for (const Method method : {Method::bdf, Method::runge_kutta}) {
    const auto traces = simulated(d, 3, method);
    EXPECT_NEAR(*std::max_element(traces.values[0].begin(), traces.values[0].end()), 0.06013, 5e-6);
  }
}

TEST(ZeroCrossings, AFollowerOfLimitedRateBehindAStepComesToAnEnd) {
  // 0.5 V/s until 1 V at 2 s. The gap closes within a nanosecond, far below the tolerance of 1e-6.
  const auto d = tools::diagram(
      {{"s", block("step", {{"after", "1 V"}})}, {"r", block("slew_limit", {{"rate", "0.5 V/s"}}, {"s"})}}, {"r"});
  const auto traces = simulated(d, 4, Method::bdf, 0.5);
  for (std::size_t k = 0; k < traces.t.size(); ++k)
    EXPECT_NEAR(traces.values[0][k], std::min(1.0, 0.5 * traces.t[k]), 1e-6);
  EXPECT_LT(traces.statistics.steps, 2000);
}

TEST(ZeroCrossings, ADeadTimeKeepsTheSignalAndNotItsValuesAtTheStepsOnly) {
  // Beside a state that is quiet half of the time; a kink and a jump in the past as well.
  const auto d = tools::diagram({{"s", sine(1.6, 0.8, -M_PI / 2)},
                                 {"d", block("dead_time", {{"delay", "0.25 s"}}, {"s"})},
                                 {"a", block("rectifier", {{"mix", 1.0}}, {"s"})},
                                 {"da", block("dead_time", {{"delay", "0.13 s"}}, {"a"})},
                                 {"j", block("rounding", {{"step", 0.5}}, {"s"})},
                                 {"dj", block("dead_time", {{"delay", "0.13 s"}}, {"j"})},
                                 {"p", block("rectifier", {{"mix", 0.5}}, {"s"})},
                                 {"q", block("integrator", {}, {"p"})}},
                                {"d", "da", "dj", "q"});
  const auto s = [](double t) { return 1.6 * std::sin(2 * M_PI * 0.8 * std::max(0.0, t) - M_PI / 2); };
  for (const Method method : {Method::bdf, Method::runge_kutta, Method::rk4}) {
    const auto traces = simulated(d, 4, method, 0.01);
    for (std::size_t k = 0; k < traces.t.size(); ++k) {
      const double t = traces.t[k];
      ASSERT_NEAR(traces.values[0][k], s(t - 0.25), 1e-5) << t << " " << method_name(method);
      ASSERT_NEAR(traces.values[1][k], std::abs(s(t - 0.13)), 1e-5) << t << " " << method_name(method);
      ASSERT_NEAR(traces.values[2][k], 0.5 * std::round(s(t - 0.13) / 0.5), 1e-5) << t << " " << method_name(method);
    }
  }
}

TEST(ZeroCrossings, ASampleAtTheStartSeesARelayThatItsInputHasSet) {
  const auto relay = [](const std::string& in) {
    return block("relay", {{"on_at", -0.2}, {"off_at", -0.9}, {"on_value", 1.0}, {"off_value", 0.0}}, {in});
  };
  const auto d = tools::diagram({{"s", sine(0.7, 0.85, M_PI / 2)},
                                 {"r", relay("s")},
                                 {"h", block("sample_hold", {{"period", "0.1 s"}}, {"r"})},
                                 {"c", block("constant", {{"value", -0.5}})},
                                 {"hc", block("sample_hold", {{"period", "0.1 s"}}, {"c"})},
                                 {"rc", relay("hc")}},
                                {"h", "rc"});
  for (const Method method : {Method::bdf, Method::runge_kutta, Method::rk4}) {
    const auto traces = simulated(d, 0.5, method, 0.05);
    for (const double h : traces.values[0]) EXPECT_EQ(h, 1);
    for (const double rc : traces.values[1]) EXPECT_EQ(rc, 0);  // nothing but the sample decides: -0.5 leaves it off
  }
}

TEST(ZeroCrossings, AtTheStartBlocksSettleInTheOrderOfTheWires) {
  // The first relay goes on and gives -1.7, which leaves the second one off, though it would go on for the 0.8 of
  // before.
  const auto d = tools::diagram(
      {{"c", block("constant", {{"value", 0.0}})},
       {"x", block("lag", {{"times", number(10, "ms")}}, {"c"})},
       {"a", block("relay", {{"on_at", -0.2}, {"off_at", -0.4}, {"on_value", -1.7}, {"off_value", 0.8}}, {"x"})},
       {"b", block("relay", {{"on_at", -1.4}, {"off_at", -1.9}, {"on_value", 1.0}, {"off_value", 0.0}}, {"a"})}},
      {"b"});
  for (const Method method : {Method::automatic, Method::bdf, Method::rk4})
    EXPECT_EQ(simulated(d, 0.1, method, 0.05).values[0].front(), 0) << method_name(method);
}

TEST(ZeroCrossings, ADeadTimeBehindASampleIsAtRestForTheSampleBehindIt) {
  // c is sampled at the start; the dead time begins as if that had been there always; what samples it sees that.
  const auto chain = [](bool switched) {
    std::vector<std::pair<std::string, Node>> blocks = {{"c", block("constant", {{"value", 2.0}})},
                                                        {"k", block("sample_hold", {{"period", "0.1 s"}}, {"c"})},
                                                        {"d", block("dead_time", {{"delay", "0.25 s"}}, {"k"})},
                                                        {"h", block("sample_hold", {{"period", "0.1 s"}}, {"d"})},
                                                        {"sum", block("sum", {{"signs", "+-"}}, {"d", "c"})}};
    if (switched) {  // not advanced from row to row
      blocks.push_back(
          {"r", block("relay", {{"on_at", 1.0}, {"off_at", -1.0}, {"on_value", 1.0}, {"off_value", 0.0}}, {"x"})});
      blocks.push_back({"x", block("lag", {{"times", number(10, "ms")}}, {"h"})});
    }
    return tools::diagram(blocks,
                          switched ? std::vector<std::string>{"h", "sum", "r"} : std::vector<std::string>{"h", "sum"});
  };
  for (const bool switched : {false, true}) {
    const auto traces = simulated(chain(switched), 1, Method::automatic, 0.05);
    for (const double h : traces.values[0]) EXPECT_EQ(h, 2) << switched;
    for (const double sum : traces.values[1]) EXPECT_EQ(sum, 0) << switched;
  }
}

TEST(ZeroCrossings, AReversalAtAKinkIsOne) {
  // The sine turns once at its top, and where it comes out of the limit below: two reversals a period.
  const auto d = tools::diagram({{"u", sine(1, 4, 0.3)},
                                 {"s", block("saturation", {{"lower", -0.6}, {"upper", 2.0}}, {"u"})},
                                 {"late", block("saturation", {{"lower", -0.7}, {"upper", 0.7}}, {"s"})},
                                 {"x", block("lag", {{"times", number(50, "ms")}}, {"late"})},
                                 {"b", block("backlash", {{"gap", 0.8}}, {"s"})}},
                                {"x", "b"});
  for (const Method method : {Method::bdf, Method::adams, Method::runge_kutta}) {
    const auto traces = simulated(d, 2, method, 0.01);
    EXPECT_EQ(traces.statistics.reversals, 16) << method_name(method);
    // Between top and limit the output moves from 0.6 to -0.2 and back.
    const auto& b = traces.values[1];
    EXPECT_NEAR(*std::max_element(b.begin() + 50, b.end()), 0.6, 1e-5);
    EXPECT_NEAR(*std::min_element(b.begin() + 50, b.end()), -0.2, 1e-5);
  }
}

TEST(ZeroCrossings, ALawThatMovesBetweenTheEndsOfAStepOnlyIsIntegrated) {
  // Behind the dead time the input falls from where it rested into the backlash, to its trough, and rises again. A step
  // over both ends sees a law that rests. Its output follows from where the backlash is met to the trough, stays until
  // the other side is met at 0.694 s, and its integral is that of the sine in between.
  constexpr double o = 0.1489, a = 0.3264, f = 2.327, delay = 0.5523, g = 0.2891 / 2;
  constexpr double w = 2 * M_PI * f, phase = -125.4 * M_PI / 180;
  const auto d = tools::diagram({{"u", sine(a, f, phase, o)},
                                 {"d", block("dead_time", {{"delay", number(delay, "s")}}, {"u"})},
                                 {"b", block("backlash", {{"gap", 2 * g}}, {"d"})},
                                 {"i", block("integrator", {}, {"b"})}},
                                {"i"});
  const double met = (-M_PI - std::asin((-g - o) / a) - phase) / w, trough = (-M_PI / 2 - phase) / w;
  const double way = (o + g) * (trough - met) - a / w * (std::cos(w * trough + phase) - std::cos(w * met + phase));
  const double rest = (o - a + g) * (0.68 - delay - trough);
  for (const Method method : {Method::bdf, Method::adams, Method::runge_kutta})
    EXPECT_NEAR(simulated(d, 2, method, 0.02).values[0][34], way + rest, 1e-6) << method_name(method);
}

TEST(ZeroCrossings, AJumpOfABlockWithoutModesSwitchesThoseBehindItAtOnce) {
  // The limiter turns round where the rounded sine jumps. Against steps of a microsecond, each late by half of one
  // where it turns: 1e-6 a turn.
  const auto d = tools::diagram(
      {{"u", sine(1.2, 2, 0.3)},
       {"r", block("rounding", {{"step", 1.0}}, {"u"})},
       {"y", block("rate_limiter", {{"rise", "0.5 1/s"}, {"fall", "0.5 1/s"}, {"time", "10 ms"}}, {"r"})}},
      {"y"});
  constexpr double h = 1e-6;
  double y = 0, t = 0;
  for (int k = 0; k < 1'400'000; ++k, t = h * k) {
    const double r = std::round(1.2 * std::sin(4 * M_PI * (t + h / 2) + 0.3));
    y += h * std::clamp((r - y) / 0.01, -0.5, 0.5);
  }
  for (const Method method : {Method::bdf, Method::adams, Method::runge_kutta})
    EXPECT_NEAR(simulated(d, 1.4, method).values[0].back(), y, 3e-6) << method_name(method);
}

TEST(ZeroCrossings, ABoucWenLawOfAnyExponentBeginsAtZero) {
  // The slope of |z|^(n-1) has no bound there, that of the law is that of a spring.
  const auto d = tools::diagram(
      {{"u", sine(1, 2)},
       {"p", block("rectifier", {{"mix", 0.5}}, {"u"})},
       {"law", block("bouc_wen",
                     {{"alpha", 0.4}, {"beta", 0.4}, {"gamma", -0.1}, {"d_p", 1.3}, {"exponent", 1.4}, {"scale", 1.4}},
                     {"p"})},
       {"x", block("lag", {{"times", number(20, "ms")}}, {"law"})}},
      {"x"});
  EXPECT_NO_THROW(simulated(d, 1, Method::bdf));
}

TEST(ZeroCrossings, ChatteringEndsWithTheBlockWhateverItsWidth) {
  for (const double width : {1e-8, 1e-9, 1e-11}) {
    const auto d = tools::diagram(
        {{"r", block("relay", {{"on_at", 0.5}, {"off_at", 0.5 - width}, {"on_value", "-1 1/s"}, {"off_value", "1 1/s"}},
                     {"x"})},
         {"x", block("integrator", {}, {"r"})}},
        {"x"});
    for (const Method method : {Method::bdf, Method::runge_kutta}) try {
        simulated(d, 1, method);
        ADD_FAILURE() << width << " " << method_name(method);
      } catch (const Error& error) {
        EXPECT_EQ(error.problems.front().code, "chattering") << error.problems.front().what;
        EXPECT_EQ(error.problems.front().path, "r");
      }
  }
}

/// Where a law of one input bends or jumps, it says so: a kink between two points is a change of sign of one of its
/// kinks. Blocks with memory follow turning points, those with modes have guards.
TEST(ZeroCrossings, EveryLawNamesItsKinks) {
  constexpr double step = 1e-3, enough = 0.02;
  for (const auto& sample : bench::samples()) {
    const bench::Bench b(sample.type, sample.values, sample.inputs);
    if (b.n_u != 1 || b.sizes.memory > 0 || b.states() > 0 || b.kernel.has_modes() || b.kernel.is_sampled() ||
        b.sizes.history)
      continue;
    const auto y = [&](double u) { return b.output(0, {u})[0]; };
    const auto kinks = [&](double u) {
      View<double> v;
      v.p = b.p.data();
      v.p_at = b.p_at.data();
      v.c = b.c.data();
      v.u = &u;
      v.n_u = 1;
      std::vector<double> k(static_cast<std::size_t>(b.sizes.kinks));
      v.out = k.data();
      if (!k.empty()) b.kernel.kinks(v);
      return k;
    };
    const double size = std::abs(y(2.5)) + std::abs(y(-2.5)) + 1;
    for (double u = -2.5; u < 2.5; u += step) {
      const double bend = (y(u + step) - 2 * y(u) + y(u - step)) / step;  // change of slope
      if (std::abs(bend) < enough * size) continue;
      const auto before = kinks(u - step), after = kinks(u + step);
      bool named = false;
      for (std::size_t i = 0; i < before.size(); ++i) named = named || (before[i] > 0) != (after[i] > 0);
      EXPECT_TRUE(named) << sample.type << " bends at " << u << " and names no kink there";
      if (!named) break;
    }
  }
}

}  // namespace
}  // namespace hysteron
