// Slopes of the exact advance with respect to parameters: closed forms, and the integrator's own sensitivities.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

SeriesPointer wave() {
  const auto t = grid(0, 0.3, 300);
  std::vector<double> v;
  for (const double s : t) v.push_back(3 - 3 * std::cos(2 * M_PI * 7 * s));
  return series(t, v);
}

Traces slopes_of(const Program& program, const SeriesPointer& u, const std::vector<std::string>& parameters,
                 Method method, double tolerance, bool at_rest = false) {
  auto run = start(program);
  bind_input(program, run, "u", u);
  SimulateOptions options{.method = method, .relative_tolerance = tolerance, .at_rest = at_rest};
  options.instants = u->t;
  for (const auto& name : parameters) options.slopes_for.push_back(program.parameter_names.at(name));
  return simulate(program, run, options);
}

TEST(AdvanceSlopes, OfALagBehindARampAreTheirClosedForm) {
  // y = g b (t - tau (1 - e)), e = exp(-t/tau): dy/dg = y/g, dy/dtau = -g b (1 - e - t/tau e).
  const double tau = 0.05, b = 10, g = 2;
  const auto program = compiled(
      diagram({{"g", block("gain", {{"gain", g}}, {"u"})}, {"y", block("lag", {{"times", list({tau}, "s")}}, {"g"})}},
              {"y"}, {{"u", "V"}}));
  const auto t = grid(0, 0.3, 100);
  auto ramp = t;
  for (auto& v : ramp) v *= b;
  const auto traces = slopes_of(*program, series(t, ramp), {"g.gain", "y.times[0]"}, Method::exact, 1e-9);
  EXPECT_EQ(traces.statistics.method, "exact");
  for (std::size_t k = 0; k < traces.t.size(); ++k) {
    const double s = traces.t[k], e = std::exp(-s / tau);
    // Widths of 1e-5 of the parameter: the square of it, and rounding divided by it.
    EXPECT_NEAR(traces.slopes[0][0][k], b * (s - tau * (1 - e)), 1e-9 * b);
    EXPECT_NEAR(traces.slopes[1][0][k], -g * b * (1 - e - s / tau * e), 1e-9 * g * b);
  }
}

TEST(AdvanceSlopes, AgreeWithTheSensitivitiesOfTheIntegrator) {
  auto law = thesis_bouc_wen("u");
  law.parameters["initial"] = "0.3 um";
  const auto program = compiled(diagram({{"law", law},
                                         {"core", thesis_operators("u")},
                                         {"both", block("sum", {}, {"law", "core"})},
                                         {"x", block("lag", {{"times", list({0.004, 0.0015}, "s")}}, {"both"})}},
                                        {"x", "law"}, {{"u", "V"}}));
  const std::vector<std::string> parameters{"law.alpha",       "law.beta",           "law.gamma", "law.initial",
                                            "core.weights[3]", "core.thresholds[4]", "x.times[0]"};
  for (const bool at_rest : {false, true}) {
    const auto ours = slopes_of(*program, wave(), parameters, Method::automatic, 1e-7, at_rest);
    EXPECT_EQ(ours.statistics.method, "exact");
    const auto theirs = slopes_of(*program, wave(), parameters, Method::bdf, 1e-8, at_rest);
    ASSERT_EQ(ours.slopes.size(), parameters.size());
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      // The tolerance is that of values, a slope may lose some hundred times as much. That of a threshold jumps where
      // its operator begins to move, somewhere inside a step of a tenth of the time constant: one part in a hundred of
      // it.
      const double tolerance = parameters[k] == "core.thresholds[4]" ? 1e-2 : 1e-4;
      EXPECT_LT(distance(ours.slopes[k][0], theirs.slopes[k][0]), tolerance * largest(theirs.slopes[k][0]))
          << parameters[k];
    }
  }
}

TEST(AdvanceSlopes, AParameterThatShiftsSamplesHasNone) {
  const auto program =
      compiled(diagram({{"held", block("sample_hold", {{"period", "10 ms"}}, {"u"})}}, {"held"}, {{"u", "V"}}));
  try {
    slopes_of(*program, wave(), {"held.period"}, Method::exact, 1e-6);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.problems.front().code, "no_slope");
  }
}

}  // namespace
}  // namespace hysteron
