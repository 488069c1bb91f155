// Numbers that make no sense, or hardly any: refused with place and cure, told, or taken exactly; never a run without
// end.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/diagram/error.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

template <class Action>
Problem problem_of(Action action) {
  try {
    action();
  } catch (const Error& e) {
    return e.problems.front();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

Diagram lag_behind(const Node& source) {
  return diagram({{"d", source}, {"p", block("lag", {{"times", list({10}, "ms")}}, {"d"})}}, {"p"});
}
Node sine_of(const std::string& frequency) { return block("sine", {{"amplitude", 1.0}, {"frequency", frequency}}); }

TEST(NonsenseNumbers, TimesOfAFileThatAreNotAboveZeroAreRefusedWhereTheyStand) {
  for (const double value : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    const auto place = [&](auto set) {
      auto d = lag_behind(sine_of("1 Hz"));
      set(d.simulate, Number{value, "s"});
      const auto p = problem_of([&] { simulate_options(*compiled(d)); });
      EXPECT_EQ(p.code, "bad_value");
      EXPECT_FALSE(p.cure.empty());
      return p.path;
    };
    EXPECT_EQ(place([](auto& s, const Number& n) { s.until = n; }), "/simulate/until");
    EXPECT_EQ(place([](auto& s, const Number& n) { s.every = n; }), "/simulate/every");
    EXPECT_EQ(place([](auto& s, const Number& n) { s.step = n; }), "/simulate/solver/step");
    EXPECT_EQ(place([](auto& s, const Number& n) { s.max_step = n; }), "/simulate/solver/max_step");
  }
}

TEST(NonsenseNumbers, AFixedStepThatIsNoneToGoOnWithIsRefused) {
  const auto program = compiled(lag_behind(sine_of("1 Hz")));
  for (const double step : {1e9, 1.5, 1e-15, 1e-300, -1.0})
    for (const auto method : {Method::rk4, Method::euler}) {
      const auto p =
          problem_of([&] { simulate(*program, start(*program), {.until = 1, .method = method, .step = step}); });
      EXPECT_EQ(p.path, "/simulate/solver/step") << step;
    }
  // Late times cannot be told apart as well: doubles near 1e9 s lie 1.2e-7 s apart.
  const auto p = problem_of([&] {
    simulate(*program, start(*program), {.begin = 1e9, .until = 1e9 + 1, .method = Method::rk4, .step = 1e-7});
  });
  EXPECT_EQ(p.path, "/simulate/solver/step");
}

TEST(NonsenseNumbers, AFixedStepBeyondWhatIsStableIsTold) {
  const auto program = compiled(lag_behind(sine_of("1 Hz")));
  const auto warnings = [&](Method method, double step) {
    const auto traces = simulate(*program, start(*program), {.until = 1, .every = 0.1, .method = method, .step = step});
    return traces.statistics.warnings;
  };
  // The time constant is 10 ms: 2 of them are Euler's limit, 2.785 that of rk4.
  EXPECT_TRUE(warnings(Method::euler, 0.0199).empty());
  ASSERT_EQ(warnings(Method::euler, 0.0201).size(), 1U);
  EXPECT_TRUE(warnings(Method::rk4, 0.0278).empty());
  ASSERT_EQ(warnings(Method::rk4, 0.0279).size(), 1U);
  EXPECT_NE(warnings(Method::rk4, 0.0279)[0].find("Take a step below 27.9 ms"), std::string::npos)
      << warnings(Method::rk4, 0.0279)[0];
}

TEST(NonsenseNumbers, ALagOnAConstantStandsAtItForTimesOfEverySize) {
  // Ten steps, each far longer than the time constant: one at their end, but for rounding of some steps.
  const auto program = compiled(lag_behind(block("constant", {{"value", 1.0}})));
  for (const double until : {100.0, 1e4, 1e6, 1e9, 1e15, 1e100, 1e300}) {
    const auto traces = simulate(*program, start(*program), {.until = until, .every = until / 10});
    EXPECT_EQ(traces.statistics.method, "exact");
    // Rows of up to 1e4 time constants lose 3e-17 of that.
    for (std::size_t k = 1; k < trace(traces).size(); ++k) EXPECT_NEAR(trace(traces)[k], 1, 5e-13) << until;
  }
}

TEST(NonsenseNumbers, WhatDecaysSlowlyIsExactBesideWhatDecaysAtOnce) {
  // Ten million time constants of one lag a row, a tenth of one of the other; a ramp in between would be exact, too.
  const double fast = 1e-7, slow = 10;
  const auto program = compiled(diagram(
      {{"d", block("constant", {{"value", 1.0}})}, {"p", block("lag", {{"times", list({slow, fast}, "s")}}, {"d"})}},
      {"p"}));
  const auto traces = simulate(*program, start(*program), {.until = 10, .every = 1});
  for (std::size_t k = 1; k < traces.t.size(); ++k)
    EXPECT_NEAR(trace(traces)[k], 1 - std::exp(-traces.t[k] / slow) * (1 + fast / slow), 1e-13);
}

TEST(NonsenseNumbers, ARampIntoALagIsExactOverVeryLongRows) {
  // y = u - T u' far behind the beginning; rows of 1e8 time constants.
  const auto program =
      compiled(diagram({{"p", block("lag", {{"times", list({10}, "ms")}}, {"u"})}}, {"p"}, {{"u", ""}}));
  hysteron::Run run = start(*program);
  bind_input(*program, run, "u", series({0, 1e7}, {0, 1e7}));
  const auto traces = simulate(*program, run, {.until = 1e7, .every = 1e6});
  for (std::size_t k = 1; k < traces.t.size(); ++k) EXPECT_NEAR(trace(traces)[k], traces.t[k] - 0.01, 1e-14 * 1e7);
}

TEST(NonsenseNumbers, ACornerThatIsNeverReachedDoesNotHoldUpTheRun) {
  for (const char* late : {"1e10 s", "1e15 s", "1e300 s", "inf s"}) {
    const auto program = compiled(lag_behind(block("step", {{"after", 1.0}, {"time", late}})));
    const auto traces = simulate(*program, start(*program), {.until = 1, .every = 0.01});
    EXPECT_EQ(largest(trace(traces)), 0) << late;
  }
}

TEST(NonsenseNumbers, ASineThatStandsStillIsOne) {
  for (const char* slow : {"1e-12 Hz", "1e-300 Hz", "1e-308 Hz", "5e-324 Hz"}) {
    const auto program = compiled(lag_behind(sine_of(slow)));
    const auto traces = simulate(*program, start(*program), {.until = 1, .every = 0.1, .method = Method::bdf});
    EXPECT_LE(largest(trace(traces)), 1e-11) << slow;  // 2 pi f t at most
  }
}

TEST(NonsenseNumbers, WhatIsNotFiniteIsRefusedButForLimits) {
  const auto refused = [](const Diagram& d) { return problem_of([&] { compiled(d); }); };
  const auto sine = block("sine", {{"amplitude", "inf um"}, {"frequency", "1 Hz"}});
  EXPECT_EQ(refused(diagram({{"d", sine}}, {"d"})).code, "bad_value");
  EXPECT_EQ(refused(lag_behind(sine_of("inf Hz"))).code, "bad_value");
  EXPECT_EQ(refused(diagram({{"d", block("constant", {{"value", "-inf V"}})}}, {"d"})).code, "bad_value");
  const auto u = std::pair{std::string("u"), sine_of("1 Hz")};
  EXPECT_EQ(refused(diagram({u, {"g", block("gain", {{"gain", "inf"}}, {"u"})}}, {"g"})).code, "bad_value");
  EXPECT_EQ(refused(diagram({u, {"g", block("dead_time", {{"delay", "inf s"}}, {"u"})}}, {"g"})).code, "bad_value");
  const auto p = refused(diagram({u, {"g", block("gain", {{"gain", "nan"}}, {"u"})}}, {"g"}));
  EXPECT_NE(p.what.find("not a number"), std::string::npos) << p.what;
  EXPECT_EQ(p.cure.find("inf"), std::string::npos) << p.cure;
  EXPECT_NO_THROW(
      compiled(diagram({u, {"s", block("saturation", {{"lower", "-20"}, {"upper", "inf"}}, {"u"})}}, {"s"})));
  EXPECT_NO_THROW(
      compiled(diagram({u, {"s", block("rate_limiter", {{"rise", "inf 1/s"}, {"fall", "inf 1/s"}}, {"u"})}}, {"s"})));
}

}  // namespace
}  // namespace hysteron
