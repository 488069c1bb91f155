// Methods with fixed steps, and explicit Runge-Kutta: orders of convergence, and the same results as the other methods.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/event_blocks.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

Diagram oscillator() {
  return diagram({{"u", block("sine", {{"amplitude", "1 V"}, {"frequency", "1 Hz"}})},
                  {"x", block("transfer_function", {{"num", list({100})}, {"den", list({1, 2, 100})}}, {"u"})}},
                 {"x"});
}

double error_with(const Program& p, Method method, double step, const std::vector<double>& reference) {
  const auto traces = simulate(p, start(p), {.until = 2, .every = 0.1, .method = method, .step = step});
  return distance(trace(traces), reference);
}

TEST(FixedStep, TheErrorFallsWithTheOrderOfTheFormula) {
  const auto p = compiled(oscillator());
  const auto reference =
      trace(simulate(*p, start(*p), {.until = 2, .every = 0.1, .method = Method::adams, .relative_tolerance = 1e-12}));
  const double euler = error_with(*p, Method::euler, 1e-3, reference) / error_with(*p, Method::euler, 5e-4, reference);
  const double rk4 = error_with(*p, Method::rk4, 1e-2, reference) / error_with(*p, Method::rk4, 5e-3, reference);
  EXPECT_NEAR(euler, 2, 0.1);  // order one
  EXPECT_NEAR(rk4, 16, 1.5);   // order four
}

TEST(FixedStep, OutputsBetweenTheStepsAreInterpolatedToTheOrderOfTheStep) {
  const auto p = compiled(oscillator());
  const std::vector<double> instants{0.1234, 0.5, 0.777, 1.99};
  const auto reference =
      simulate(*p, start(*p), {.instants = instants, .method = Method::adams, .relative_tolerance = 1e-12});
  const auto fixed = simulate(*p, start(*p), {.instants = instants, .method = Method::rk4, .step = 0.005});
  // cubic Hermite: (step * 10 rad/s)^4 / 384 of the amplitude, 2e-8, beside the formula's own error
  EXPECT_LT(distance(trace(fixed), trace(reference)), 1e-5);
}

TEST(FixedStep, ASampledLoopAndMemoryFollowTheSameInstants) {
  const auto p = compile(diagram({{"r", block("sine", {{"amplitude", "1 V"}, {"frequency", "2 Hz"}})},
                                  {"e", block("sum", {{"signs", "+-"}}, {"r", "x"})},
                                  {"s", block("test_accumulator", {{"gain", 0.2}, {"period", "5 ms"}}, {"e"})},
                                  {"h", block("play", {{"radius", "0.05 V"}}, {"s"})},
                                  {"x", block("lag", {{"times", list({0.02}, "s")}}, {"h"})}},
                                 {"x", "s"}),
                         test::registry_with_events());
  const SimulateOptions adaptive{
      .until = 1, .every = 0.005, .method = Method::runge_kutta, .relative_tolerance = 1e-10};
  const SimulateOptions fixed{.until = 1, .every = 0.005, .method = Method::rk4, .step = 0.5e-3};
  const auto a = simulate(*p, start(*p), adaptive), b = simulate(*p, start(*p), fixed);
  // (0.5 ms / 20 ms)^4 / 120 per step of RK4
  for (std::size_t s = 0; s < 2; ++s) EXPECT_LT(distance(a.values[s], b.values[s]), 1e-8);
  EXPECT_EQ(b.statistics.steps, 2000);
  EXPECT_EQ(b.statistics.method, "rk4");
}

TEST(FixedStep, NeedsAStep) {
  const auto p = compiled(oscillator());
  try {
    simulate(*p, start(*p), {.until = 1, .method = Method::rk4});
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.problems.front().path, "/simulate/solver/step");
  }
}

TEST(RungeKutta, GivesTheClosedLoopsOfTheOtherMethods) {
  for (const auto& d : {bouc_wen_loop(), play_loop()}) {
    const auto p = compiled(d);
    const SimulateOptions tight{.until = 0.2, .every = 1e-3, .method = Method::bdf, .relative_tolerance = 1e-9};
    SimulateOptions explicit_one = tight;
    explicit_one.method = Method::runge_kutta;
    const auto a = simulate(*p, start(*p), tight), b = simulate(*p, start(*p), explicit_one);
    for (std::size_t s = 0; s < a.values.size(); ++s)
      EXPECT_LT(distance(a.values[s], b.values[s]),
                1e-6 * largest(a.values[s]));  // both within some hundred tolerances
  }
}

}  // namespace
}  // namespace hysteron
