// How large signals and states are guessed to be, and that no guess ends a simulation.
#include "engine/program/nominal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

/// Lags in a ring: each reads 0.3 of the one before it and the whole of the one behind it, the first a sine of 1. What
/// comes forward falls by 0.3 a lag; what comes backward round the ring does not.
Diagram ring(int n) {
  Diagram d;
  d.blocks["u"] = block("sine", {{"amplitude", 1.0}, {"frequency", "3 Hz"}});
  for (int k = 0; k < n; ++k) {
    const auto name = [](const char* what, int i) { return what + std::to_string(i); };
    d.blocks[name("s", k)] = block("sum", {}, {k == 0 ? "u" : name("g", k - 1), name("x", (k + 1) % n)});
    d.blocks[name("x", k)] = block("lag", {{"times", list({2e-3}, "s")}}, {name("s", k)});
    d.blocks[name("g", k)] = block("gain", {{"gain", 0.3}}, {name("x", k)});
  }
  d.record = {"g" + std::to_string(n - 1)};
  return d;
}

TEST(NominalSizes, AreThoseOfTheLargestWayToABlock) {
  const auto program = compiled(ring(150));
  const auto sizes = nominal_states(*program, start(*program));
  // Forward 0.3^149 = 1e-78 of the drive; backward each as large as the first.
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    EXPECT_GT(sizes[i], 0.5) << program->state_names[i];
    EXPECT_LT(sizes[i], 2.0) << program->state_names[i];
  }
}

TEST(NominalSizes, OfAWeakWayEndNoSimulation) {
  // Dormand and Prince's method of order 8 in SciPy, relative tolerance 1e-8 on matrices written by hand.
  constexpr double expected = 1.8592325501e-4;
  for (const Method method : {Method::bdf, Method::adams, Method::runge_kutta}) {
    SimulateOptions options;
    options.until = 1e-3;
    options.every = 1e-3;
    options.method = method;
    options.relative_tolerance = 1e-9;
    const auto program = compiled(ring(150));
    const auto result = simulate(*program, start(*program), options);
    // Ten tolerances of a signal of nominal size 0.3.
    EXPECT_NEAR(trace(result).back(), expected, 10 * 1e-9 * 0.3) << static_cast<int>(method);
  }
}

TEST(NominalSizes, DoNotGrowRoundALoop) {
  // A loop with gain 5 behind a lag: unstable, but its signals are told by the drive.
  const auto d = diagram({{"u", block("sine", {{"amplitude", 1.0}, {"frequency", "3 Hz"}})},
                          {"in", block("sum", {}, {"u", "back"})},
                          {"x", block("lag", {{"times", list({2e-3}, "s")}}, {"in"})},
                          {"back", block("gain", {{"gain", 5.0}}, {"x"})}},
                         {"x"});
  const auto program = compiled(d);
  const auto sizes = nominal_states(*program, start(*program));
  EXPECT_GT(sizes[0], 0.5);
  EXPECT_LT(sizes[0], 10.0);
}

}  // namespace
}  // namespace hysteron
