// Slopes of simulations with respect to parameters: closed forms, and differences of simulations with tight tolerances.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/event_blocks.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

int place_of(const Program& p, const std::string& parameter) {
  const auto found = p.parameter_names.find(parameter);
  EXPECT_NE(found, p.parameter_names.end()) << parameter;
  return found == p.parameter_names.end() ? 0 : found->second;
}

Traces with_slopes(const Program& p, const std::vector<std::string>& parameters, SimulateOptions options) {
  for (const auto& name : parameters) options.slopes_for.push_back(place_of(p, name));
  return simulate(p, start(p), options);
}

/// d(first signal)/d(parameter) by a central difference of whole simulations.
std::vector<double> by_differences(const Program& p, const std::string& parameter, SimulateOptions options,
                                   double share = 1e-4) {
  options.relative_tolerance = 1e-11;
  const double value = p.parameters[static_cast<std::size_t>(place_of(p, parameter))].value;
  const double h = share * std::abs(value);
  std::vector<std::vector<double>> sides;
  for (const double sign : {1.0, -1.0}) {
    auto run = start(p);
    set_parameter(p, run, parameter, value + sign * h);
    reset(p, run);
    sides.push_back(trace(simulate(p, run, options)));
  }
  std::vector<double> slope;
  for (std::size_t i = 0; i < sides[0].size(); ++i) slope.push_back((sides[0][i] - sides[1][i]) / (2 * h));
  return slope;
}

void expect_slopes_as_by_differences(const Diagram& d, const std::vector<std::string>& parameters,
                                     const SimulateOptions& options, double tolerance) {
  const auto p = compile(d, test::registry_with_events());
  const auto traces = with_slopes(*p, parameters, options);
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const auto expected = by_differences(*p, parameters[k], options);
    EXPECT_GT(largest(expected), 0) << parameters[k] << ": a test that compares zeros is none";
    EXPECT_LT(distance(traces.slopes[k][0], expected), tolerance * largest(expected)) << parameters[k];
  }
}

TEST(Slopes, OfALagAreItsClosedForm) {
  // x = a (1 - exp(-t/tau)): dx/da = 1 - exp(-t/tau), dx/dtau = -a t/tau^2 exp(-t/tau).
  const double a = 2, tau = 0.3;
  const auto p = compiled(
      diagram({{"u", block("constant", {{"value", "2 V"}})}, {"x", block("lag", {{"times", list({tau}, "s")}}, {"u"})}},
              {"x"}));
  for (const auto method : {Method::bdf, Method::adams, Method::runge_kutta}) {
    const auto traces = with_slopes(*p, {"u.value", "x.times[0]"},
                                    {.until = 1, .every = 0.05, .method = method, .relative_tolerance = 1e-9});
    for (std::size_t i = 0; i < traces.t.size(); ++i) {
      const double e = std::exp(-traces.t[i] / tau);
      EXPECT_NEAR(traces.slopes[0][0][i], 1 - e, 1e-7);
      EXPECT_NEAR(traces.slopes[1][0][i], -a * traces.t[i] / (tau * tau) * e, 1e-6);
    }
  }
}

TEST(Slopes, OfParametersThatBlocksPrepareAreThere) {
  // The coefficients of a transfer function reach its states through a balanced form.
  expect_slopes_as_by_differences(
      diagram({{"u", block("sine", {{"amplitude", "1 V"}, {"frequency", "3 Hz"}})},
               {"x", block("transfer_function", {{"num", list({900})}, {"den", list({1, 6, 900})}}, {"u"})}},
              {"x"}),
      {"x.num[0]", "x.den[1]", "x.den[2]", "u.frequency"},
      {.until = 1, .every = 0.05, .method = Method::bdf, .relative_tolerance = 1e-9}, 1e-5);
}

TEST(Slopes, OfAHystereticLoopCountWhatMemoryRemembers) {
  // With memory taken as constant the slope of the gain has the wrong sign.
  expect_slopes_as_by_differences(play_loop(), {"amplifier.gain", "hysteresis.weights[3]", "hysteresis.thresholds[2]"},
                                  {.until = 0.45, .every = 0.003, .method = Method::bdf, .relative_tolerance = 1e-8},
                                  2e-3);  // reversals and kinks are found within the tolerance, slopes jump there
}

TEST(Slopes, OfALawDrivenByItsRate) {
  expect_slopes_as_by_differences(bouc_wen_loop(), {"hysteresis.alpha", "hysteresis.beta", "controller.kp"},
                                  {.until = 0.3, .every = 0.002, .method = Method::bdf, .relative_tolerance = 1e-8},
                                  1e-3);
}

TEST(Slopes, OfASampledLoopAreThoseOfItsRecursion) {
  const double tau = 0.3, period = 0.05, gain = 0.2, a = std::exp(-period / tau);
  const auto p = compile(diagram({{"r", block("constant", {{"value", "1 V"}})},
                                  {"e", block("sum", {{"signs", "+-"}}, {"r", "x"})},
                                  {"s", block("test_accumulator", {{"gain", gain}, {"period", "0.05 s"}}, {"e"})},
                                  {"x", block("lag", {{"times", list({tau}, "s")}}, {"s"})}},
                                 {"x"}),
                         test::registry_with_events());
  const auto traces = with_slopes(
      *p, {"s.gain"}, {.until = 2, .every = 0.05, .method = Method::runge_kutta, .relative_tolerance = 1e-9});
  double x = 0, s = 0, dx = 0, ds = 0;
  for (std::size_t k = 0; k < traces.t.size(); ++k) {
    EXPECT_NEAR(traces.slopes[0][0][k], dx, 1e-6) << k;
    const double next_dx = a * dx + (1 - a) * ds, next_x = a * x + (1 - a) * s;
    ds += (1 - x) - gain * dx;
    s += gain * (1 - x);
    x = next_x;
    dx = next_dx;
  }
}

TEST(Slopes, OfABallChangeWithTheTimeOfItsBounce) {
  // Behind the first bounce: t0 = sqrt(2 h0/g), v = e g t0, height = v (t - t0) - g (t - t0)^2/2.
  const double g = 10, e = 0.8, h0 = 1, t0 = std::sqrt(2 * h0 / g);
  const auto p = compile(
      diagram(
          {{"push", block("constant", {{"value", "0 m/s^2"}})},
           {"ball", block("test_ball", {{"gravity", "10 m/s^2"}, {"restitution", e}, {"height", "1 m"}}, {"push"})}},
          {"ball"}),
      test::registry_with_events());
  const SimulateOptions options{
      .instants = {0.1, 0.4, 0.6, 0.9, 1.1}, .method = Method::bdf, .relative_tolerance = 1e-9};
  const auto traces = with_slopes(*p, {"ball.restitution", "ball.height"}, options);
  for (std::size_t i = 0; i < traces.t.size(); ++i) {
    const double t = traces.t[i], since = t - t0;
    if (since < 0) {
      EXPECT_NEAR(traces.slopes[0][0][i], 0, 1e-7);
      EXPECT_NEAR(traces.slopes[1][0][i], 1, 1e-6);
      continue;
    }
    const double dt0 = t0 / (2 * h0);
    EXPECT_NEAR(traces.slopes[0][0][i], g * t0 * since, 1e-5) << t;
    EXPECT_NEAR(traces.slopes[1][0][i], e * g * dt0 * since - e * g * t0 * dt0 + g * since * dt0, 1e-5) << t;
  }
}

TEST(Slopes, OfARelayShiftItsSwitching) {
  // Off a switching instant, where the signal itself has a corner.
  expect_slopes_as_by_differences(
      diagram({{"minus", block("gain", {{"gain", -1.0}}, {"relay"})},
               {"x", block("lag", {{"times", list({0.1}, "s")}}, {"minus"})},
               {"relay", block("test_relay", {{"on", "0.2 V"}, {"off", "-0.2 V"}, {"level", "1 V"}}, {"x"})}},
              {"x"}),
      {"relay.on", "relay.level", "x.times[0]"},
      {.instants = {0.013, 0.05, 0.09, 0.13, 0.2, 0.31}, .method = Method::bdf, .relative_tolerance = 1e-9}, 1e-4);
}

TEST(Slopes, FollowAJumpAlongItsPath) {
  expect_slopes_as_by_differences(diagram({{"step", block("step", {{"after", "4 V"}, {"time", "0.5 s"}})},
                                           {"play", block("play", {{"radius", "0.5 V"}}, {"step"})},
                                           {"y", thesis_bouc_wen("play")}},
                                          {"y"}),
                                  {"step.after", "y.alpha", "y.gamma", "play.radius"},
                                  {.until = 1, .every = 0.1, .method = Method::bdf, .relative_tolerance = 1e-9}, 1e-4);
}

TEST(Slopes, OfAnInstantAreRefused) {
  const auto p = compiled(diagram({{"step", block("step", {{"after", "4 V"}, {"time", "0.5 s"}})},
                                   {"x", block("lag", {{"times", list({0.1}, "s")}}, {"step"})}},
                                  {"x"}));
  try {
    with_slopes(*p, {"step.time"}, {.until = 1, .method = Method::bdf});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.problems.front().code, "no_slope");
    EXPECT_EQ(error.problems.front().path, "step.time");
  }
}

}  // namespace
}  // namespace hysteron
