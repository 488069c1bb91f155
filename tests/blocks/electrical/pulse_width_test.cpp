// Pulse width modulation: means and edges where the closed forms say, with every method; and what a bridge makes of it.
#include "models/electrical/pulse_width.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/blocks/bench.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using bench::Bench;
using tools::block;

double simulated(const Diagram& d, double until, Method method = Method::automatic) {
  const auto program = tools::compiled(d);
  SimulateOptions options;
  options.instants = {until};
  options.method = method;
  options.step = 1e-3;
  return simulate(*program, start(*program), options).values[0].back();
}

Node modulator(const std::string& modulation) {
  return block("pwm", {{"frequency", "10 Hz"}, {"modulation", modulation}}, {"d"});
}

/// Time in [0, t] in which the carrier of 10 Hz is below the level: whole periods, and what is left of them.
double time_below(double level, double t) {
  const double share = (1 + level) / 2;  // of a period, half of it on each side of the lower corner at t = 0
  const double turns = 10 * t, whole = std::floor(turns), rest = turns - whole;
  return (whole * share + std::min(rest, share / 2) + std::max(0.0, rest - (1 - share / 2))) / 10;
}

TEST(PwmBlock, PulsesAreAsWideAsTheDutySays) {
  for (const double duty : {-0.8, -0.3, 0.0, 0.45, 0.9})
    for (const double until : {0.31, 0.52, 0.97, 2.0})
      for (const Method method : {Method::bdf, Method::runge_kutta, Method::rk4}) {
        const auto integral = [&](const std::string& modulation, double d) {
          return simulated(tools::diagram({{"d", block("constant", {{"value", d}})},
                                           {"p", modulator(modulation)},
                                           {"i", block("integrator", {}, {"p"})}},
                                          {"i"}),
                           until, method);
        };
        const double up = time_below(duty, until), down = time_below(-duty, until);
        // ten times the relative tolerance of 1e-6; pulses have two edges each, found to rounding
        EXPECT_NEAR(integral("bipolar", duty), 2 * up - until, 1e-5) << duty << " " << until;
        EXPECT_NEAR(integral("unipolar", duty), up - down, 1e-5) << duty << " " << until;
        EXPECT_NEAR(integral("single", (1 + duty) / 2), up, 1e-5) << duty << " " << until;
      }
}

TEST(PwmBlock, HasNoPulsesOfNoWidth) {
  for (const double duty : {-1.0, 1.0, -1.5, 2.0})
    for (const std::string modulation : {"bipolar", "unipolar"}) {
      const auto d = tools::diagram({{"d", block("constant", {{"value", duty}})},
                                     {"p", modulator(modulation)},
                                     {"i", block("integrator", {}, {"p"})}},
                                    {"i"});
      EXPECT_NEAR(simulated(d, 0.52), duty > 0 ? 0.52 : -0.52, 1e-9) << modulation << " " << duty;
    }
}

TEST(PwmBlock, FollowsADutyThatMoves) {
  // The mean over the pulses of a slow sine: its own integral, but for the rest of half a pulse.
  const auto d = tools::diagram({{"d", block("sine", {{"amplitude", 0.8}, {"frequency", "0.5 Hz"}})},
                                 {"p", block("pwm", {{"frequency", "1 kHz"}}, {"d"})},
                                 {"i", block("integrator", {}, {"p"})}},
                                {"i"});
  EXPECT_NEAR(simulated(d, 1), 0.8 * 2 / M_PI, 1e-5);
}

TEST(PwmBlock, DrivesACurrentWithTheRippleOfTheClosedForm) {
  // Duty 0: a square wave of +-V. Steady: from -peak to peak in half a period, peak = V/R tanh(T/(4 tau)).
  const double v = 24, r = 2, tau = 3e-3, period = 1e-3, peak = v / r * std::tanh(period / (4 * tau));
  const double at_middle = v / r - (v / r + peak) * std::exp(-period / 4 / tau);  // t = 0 halves a pulse
  const auto d = tools::diagram(
      {{"d", block("constant", {{"value", 0.0}})},
       {"p", block("pwm", {{"frequency", "1 kHz"}}, {"d"})},
       {"b", block("h_bridge", {{"supply", "24 V"}}, {"p", "w"})},
       {"e", block("constant", {{"value", "0 V"}})},
       {"w", block("winding",
                   {{"resistance", "2 ohm"}, {"inductance", "6 mH"}, {"initial", fmt::format("{:.17g} A", at_middle)}},
                   {"b", "e"})}},
      {"w"});
  for (const Method method : {Method::bdf, Method::runge_kutta}) {
    EXPECT_NEAR(simulated(d, 10.25e-3, method), peak, 1e-4 * peak);
    EXPECT_NEAR(simulated(d, 10.75e-3, method), -peak, 1e-4 * peak);
  }
}

TEST(PwmModel, CarrierIsATriangleWhoseCornersAreNamed) {
  EXPECT_EQ(pulse_width::carrier(10.0, 0.0), -1);
  EXPECT_NEAR(pulse_width::carrier(10.0, 0.025), 0, 1e-15);
  EXPECT_EQ(pulse_width::carrier(10.0, 0.05), 1);
  EXPECT_NEAR(pulse_width::next_corner(10, 0.01), 0.05, 1e-15);
  EXPECT_NEAR(pulse_width::next_corner(10, 0.07), 0.1, 1e-15);
}

TEST(HBridgeBlock, LosesVoltageAtItsSwitchesAndPauses) {
  EXPECT_EQ(Bench("h_bridge", {{"supply", {24}}, {"resistance", {0.1}}}).output(0, {0.5, 3})[0], 12 - 0.3);
  const Bench b("h_bridge_with_dead_time", {{"supply", {24}}, {"resistance", {0.1}}, {"loss", {0.4}}});
  EXPECT_DOUBLE_EQ(b.output(0, {0.5, 3})[0], 12 - 0.3 - 0.4);
  EXPECT_DOUBLE_EQ(b.output(0, {0.5, -3})[0], 12 + 0.3 + 0.4);
  EXPECT_EQ(b.output(0, {0.5, 0})[0], 12);
}

}  // namespace
}  // namespace hysteron
