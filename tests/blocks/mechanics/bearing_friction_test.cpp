// Friction beside a damping in a diagram: rows against the integrator, and a wheel that it brings to rest.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using tools::block;

std::vector<double> even_rows(double until, int rows) {
  std::vector<double> t;
  for (int k = 0; k <= rows; ++k) t.push_back(until * k / rows);
  return t;
}

TEST(BearingFriction, RowsAreWhatTheIntegratorMakesOfTheLaw) {
  const auto program = tools::compiled(tools::diagram(
      {{"y",
        block(
            "bearing_friction",
            {{"level", "2 rad/s"}, {"slip_distance", "0.01 rad"}, {"excess", 0.5}, {"stribeck_velocity", "0.3 rad/s"}},
            {"w"})}},
      {"y"}, {{"w", "rad/s"}}));
  const auto t = even_rows(3, 600);
  std::vector<double> w;
  for (const double s : t) w.push_back(std::sin(5 * s));
  auto run = start(*program);
  bind_input(*program, run, "w", tools::series(t, w));
  SimulateOptions options{.method = Method::automatic, .relative_tolerance = 1e-9};
  options.instants = t;
  const Traces rows = simulate(*program, run, options);
  options.method = Method::bdf;
  const Traces integrated = simulate(*program, run, options);
  EXPECT_EQ(rows.statistics.method, "exact");
  // The tolerance of the integrator a hundred times over, of values up to 4: its rows are closed forms.
  for (std::size_t k = 0; k < t.size(); ++k) EXPECT_NEAR(rows.values[0][k], integrated.values[0][k], 4e-7) << t[k];
}

TEST(BearingFriction, BringsAWheelToRestWhenCoulombsLawDoes) {
  // J w' = -b (w + level sgn w): w = (w_0 + level) exp(-t b/J) - level, at rest where that is 0.
  const auto program = tools::compiled(tools::diagram(
      {{"w", block("integrator", {{"initial", "10 rad/s"}}, {"rate"})},
       {"friction", block("bearing_friction", {{"level", "2 rad/s"}, {"slip_distance", "1 mrad"}}, {"w"})},
       {"bearing", block("gain", {{"gain", "0.4 N m s/rad"}}, {"friction"})},
       {"rate", block("gain", {{"gain", "-2 rad/s^2/(N m)"}}, {"bearing"})}},
      {"w"}));
  SimulateOptions options{.method = Method::automatic, .relative_tolerance = 1e-9};
  options.instants = even_rows(4, 200);
  options.until = 4;
  const Traces run = simulate(*program, start(*program), options);
  const double rest = std::log((10.0 + 2) / 2) / 0.8;
  for (std::size_t k = 0; k < options.instants.size(); ++k) {
    const double t = options.instants[k];
    // It begins to slide within some slip distances: by 1.6 rad/s^2 for 1 mrad at 10 rad/s it is faster, 2e-4 rad/s.
    // It sticks like a spring: from the speed that is left a slip distance before rest, sqrt(2*1.6*1e-3) = 0.06, it
    // may turn back.
    const bool slides = t < rest - 0.1;
    EXPECT_NEAR(run.values[0][k], t < rest ? 12 * std::exp(-0.8 * t) - 2 : 0, slides ? 2e-4 : 0.06) << t;
  }
}

}  // namespace
}  // namespace hysteron
