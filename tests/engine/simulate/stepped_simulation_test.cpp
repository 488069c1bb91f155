// A diagram that is taken along step by step: the same as simulate(), inputs that are held, copies.
#include "engine/simulate/stepped_simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "engine/diagram/stop.h"
#include "tests/engine/event_blocks.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using namespace tools;

/// A sampled controller, memory and a lag in a loop, behind a sine.
ProgramPointer sampled_loop() {
  return compile(diagram({{"r", block("sine", {{"amplitude", "1 V"}, {"frequency", "2 Hz"}})},
                          {"e", block("sum", {{"signs", "+-"}}, {"r", "x"})},
                          {"s", block("test_accumulator", {{"gain", 0.2}, {"period", "5 ms"}}, {"e"})},
                          {"h", block("play", {{"radius", "0.05 V"}}, {"s"})},
                          {"x", block("lag", {{"times", list({0.02}, "s")}}, {"h"})}},
                         {"x", "s"}),
                 test::registry_with_events());
}

/// The lag of an input of the diagram.
ProgramPointer driven_lag() {
  Diagram d = diagram({{"x", block("lag", {{"times", list({0.02}, "s")}}, {"u"})}}, {"x"});
  d.inputs["u"].unit = "V";
  return compiled(d);
}

TEST(Stepper, StepsOfAnyLengthGiveWhatARunGives) {
  const auto p = sampled_loop();
  const SimulateOptions options{.until = 0.7, .every = 0.005, .relative_tolerance = 1e-9};
  const auto run = simulate(*p, start(*p), options);
  for (const double factor : {0.1, 1.0, 7.0}) {
    SteppedSimulation stepper(p, options);
    const double step = factor * options.every;
    const auto last = static_cast<int>(std::lround(options.until / step));
    for (int k = 0; k <= last; ++k) {
      stepper.advance(k * step);
      const double row = k * factor;
      if (std::abs(row - std::round(row)) > 1e-9) continue;
      for (std::size_t s = 0; s < run.signals.size(); ++s)
        // both are held to 1e-9 of signals of size 1 in each step
        EXPECT_NEAR(stepper.value(run.signals[s]), run.values[s][static_cast<std::size_t>(std::lround(row))], 1e-7)
            << "step " << step << ", t " << stepper.t();
    }
  }
}

TEST(Stepper, TheIntegratorStaysWarmWhereNothingJumps) {
  const auto p = compiled(diagram({{"u", block("sine", {{"amplitude", "1 V"}, {"frequency", "1 Hz"}})},
                                   {"x", block("lag", {{"times", list({0.02}, "s")}}, {"u"})}},
                                  {"x"}));
  SteppedSimulation stepper(p, {.until = 1});
  stepper.advance(1e-3);
  const long begun = stepper.restarts();
  for (int k = 2; k <= 1000; ++k) stepper.advance(k * 1e-3);
  EXPECT_EQ(stepper.restarts(), begun);

  SteppedSimulation driven(driven_lag(), {.until = 1});
  for (int k = 1; k <= 10; ++k) {
    driven.set(0, k);
    driven.advance(k * 0.1);
  }
  EXPECT_EQ(driven.restarts(), 9);  // where its input jumps it begins anew: not at the first value, which is the start
}

TEST(Stepper, AnInputIsHeldFromWhereItIsSet) {
  const auto p = driven_lag();
  SteppedSimulation stepper(p, {.until = 1, .relative_tolerance = 1e-9});
  const int x = p->signal("x");
  double expected = 0, held = 0;
  for (int k = 0; k < 50; ++k) {
    held = std::sin(0.3 * k);
    stepper.set(0, held);
    stepper.advance((k + 1) * 0.01);
    expected = held + (expected - held) * std::exp(-0.01 / 0.02);  // of a lag behind a constant
    EXPECT_NEAR(stepper.value(x), expected, 1e-8);                 // ten steps of 1e-9 each
  }
}

TEST(Stepper, WhatIsSetIsThereBeforeWhatIsSampledAtTheSameInstant) {
  Diagram d = diagram({{"s", block("test_accumulator", {{"gain", 1}, {"period", "10 ms"}}, {"u"})}}, {"s"});
  d.inputs["u"].unit = "V";
  const auto p = compile(d, test::registry_with_events());
  const auto series = std::make_shared<Series>(Series{{0, 0.01, 0.02, 0.03}, {1, 10, 100, 1000}, Between::hold});
  auto recorded = start(*p);
  bind_input(*p, recorded, "u", series);
  const auto run = simulate(*p, recorded, {.until = 0.035, .instants = {0.005, 0.015, 0.025, 0.035}});
  SteppedSimulation stepper(p, {.until = 0.04});
  const int s = p->signal("s");
  for (std::size_t k = 0; k < 4; ++k) {
    stepper.set(0, series->v[k]);
    stepper.advance(static_cast<double>(k) * 0.01 + 0.005);
    EXPECT_EQ(stepper.value(s), run.values[0][k]);
    stepper.advance(static_cast<double>(k + 1) * 0.01);
    EXPECT_EQ(stepper.value(s), run.values[0][k]) << "what is sampled at the end waits for its input";
  }
}

TEST(Stepper, MemoryFollowsTheJumpOfAnInput) {
  Diagram d = diagram({{"h", block("play", {{"radius", "0.5 V"}}, {"u"})}}, {"h"});
  d.inputs["u"].unit = "V";
  const auto p = compiled(d);
  SteppedSimulation stepper(p, {.until = 1});
  const int h = p->signal("h");
  const double inputs[] = {2, -1, 0.2, 3}, held[] = {1.5, -0.5, -0.3, 2.5};  // the play operator by hand
  for (int k = 0; k < 4; ++k) {
    stepper.set(0, inputs[k]);
    stepper.advance(0.1 * (k + 1));
    EXPECT_NEAR(stepper.value(h), held[k], 1e-12);
  }
}

TEST(Stepper, ACopyGoesOnByItself) {
  const auto p = sampled_loop();
  const SimulateOptions options{.until = 1, .relative_tolerance = 1e-9};
  SteppedSimulation one(p, options);
  one.advance(0.333);
  SteppedSimulation two = one;
  one.advance(0.9);
  EXPECT_EQ(two.t(), 0.333);
  two.advance(0.9);
  for (const int s : p->record_signals) EXPECT_NEAR(one.value(s), two.value(s), 1e-7);  // as for steps of any length

  const auto driven = driven_lag();
  SteppedSimulation left(driven, {.until = 1});
  left.set(0, 1);
  left.advance(0.01);
  SteppedSimulation right = left;
  right.set(0, -1);
  left.advance(1);
  right.advance(1);
  EXPECT_NEAR(left.value(driven->signal("x")), 1, 1e-5);
  EXPECT_NEAR(right.value(driven->signal("x")), -1, 1e-5);
}

TEST(Stepper, WhatCannotBeIsRefusedAndMayBeDoneRightBehindIt) {
  const auto p = driven_lag();
  SteppedSimulation stepper(p, {.until = 1});
  stepper.advance(0.5);
  EXPECT_THROW(stepper.advance(0.4), Error);
  EXPECT_THROW(stepper.set(1, 0), Error);
  EXPECT_THROW(stepper.set(0, std::nan("")), Error);
  EXPECT_THROW(stepper.value(99), Error);
  stepper.advance(0.6);
  EXPECT_EQ(stepper.t(), 0.6);
}

// Stopped again and again at whatever step it looks up, it comes to the bits of a stepper that nobody stops.
TEST(Stepper, WhatWasStoppedGoesOnToTheSameBits) {
  const auto p = sampled_loop();
  const SimulateOptions options{.until = 20, .relative_tolerance = 1e-9};
  SteppedSimulation through(p, options), stopped(p, options);
  through.advance(20);
  int stops = 0;
  while (stopped.t() < 20) {
    bool stop = false;  // at every other time that somebody asks
    const StopScope scope([&] { return std::exchange(stop, !stop); });
    const double before = stopped.t();
    try {
      stopped.advance(20);
    } catch (const Stopped&) {
      ++stops;
      EXPECT_GT(stopped.t(), before);
      EXPECT_LT(stopped.t(), 20);
    }
  }
  EXPECT_GT(stops, 3);
  for (const int s : p->record_signals) EXPECT_EQ(stopped.value(s), through.value(s));
}

TEST(Stepper, WhatFailedDoesNotGoOn) {
  const auto p = compiled(diagram({{"e", block("expression", {{"y", "u*u"}}, {"x"})},
                                   {"g", block("gain", {{"gain", "1 1/s"}}, {"e"})},
                                   {"x", block("integrator", {{"initial", 1}}, {"g"})}},
                                  {"x"}));
  SteppedSimulation stepper(p, {.until = 2});  // dx/dt = x^2 from 1 is at infinity at 1 s
  stepper.advance(0.5);
  EXPECT_NEAR(stepper.value(p->signal("x")), 2, 1e-4);
  SteppedSimulation before = stepper;
  EXPECT_THROW(stepper.advance(2), Error);
  try {
    stepper.advance(2.1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.problems.front().code, "stepper_failed");
  }
  before.advance(0.75);
  EXPECT_NEAR(before.value(p->signal("x")), 4, 1e-3);
}

}  // namespace
}  // namespace hysteron
