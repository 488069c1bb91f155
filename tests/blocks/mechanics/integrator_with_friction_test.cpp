// A speed on which dry friction acts, against closed forms and against a mass of 1 kg without a spring.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using tools::block;

Traces simulated_by(Method method, const Diagram& d, const std::vector<double>& instants, double tolerance) {
  const auto program = tools::compiled(d);
  SimulateOptions options;
  for (const auto& [name, from] : d.outputs) options.signals.push_back(program->signal(from));
  options.instants = instants;
  options.until = instants.back();
  options.relative_tolerance = tolerance;
  options.method = method;
  return simulate(*program, start(*program), options);
}

TEST(IntegratorWithFriction, ComesToRestAndStays) {
  // 3 rad/s less 2 rad/s each second.
  const auto d = tools::diagram(
      {{"u", block("constant", {{"value", "0 rad/s^2"}})},
       {"w", block("integrator_with_friction", {{"level", "2 rad/s^2"}, {"initial", "3 rad/s"}}, {"u"})}},
      {"w"});
  const auto t = tools::grid(0, 3, 60);
  const auto w = simulated_by(Method::bdf, d, t, 1e-8).values[0];
  for (std::size_t k = 0; k < t.size(); ++k) EXPECT_NEAR(w[k], std::max(0.0, 3 - 2 * t[k]), 1e-9) << t[k];
}

TEST(IntegratorWithFriction, IsTheSpeedOfAMassOfOne) {
  const auto d = tools::diagram({{"f", block("sine", {{"amplitude", "3 N"}, {"frequency", "0.7 Hz"}})},
                                 {"a", block("gain", {{"gain", "1 m/s^2/N"}}, {"f"})},
                                 {"m", block("mass_with_friction",
                                             {{"mass", "1 kg"},
                                              {"coulomb", "1 N"},
                                              {"excess", 0.4},
                                              {"stribeck_velocity", "0.1 m/s"},
                                              {"stribeck_exponent", 1.0},
                                              {"initial_velocity", "-0.3 m/s"}},
                                             {"f"})},
                                 {"v", block("integrator_with_friction",
                                             {{"level", "1 m/s^2"},
                                              {"excess", 0.4},
                                              {"stribeck_velocity", "0.1 m/s"},
                                              {"stribeck_exponent", 1.0},
                                              {"initial", "-0.3 m/s"}},
                                             {"a"})}},
                                {"m.velocity", "v"});
  const auto traces = simulated_by(Method::bdf, d, tools::grid(0, 5, 100), 1e-9);
  EXPECT_GT(tools::largest(traces.values[0]), 0.1);
  // Some hundred times the tolerance of the integrator.
  EXPECT_LT(tools::distance(traces.values[0], traces.values[1]), 1e-7 * tools::largest(traces.values[0]));
}

}  // namespace
}  // namespace hysteron
