// Machines: energy is kept, currents are those of the closed forms, and own steps through rows are the law's.
#include <gtest/gtest.h>

#include <cmath>

#include "blocks/electrical/synchronous_machines.h"
#include "models/random.h"
#include "tests/blocks/bench.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using bench::Bench;
using bench::Numbers;
using tools::block;

double draw(std::uint64_t trial, std::uint64_t i, double scale = 1) { return scale * random::normal(31, trial, i); }

TEST(WindingBlock, CurrentRisesWithItsTimeConstant) {
  const auto program = tools::compiled(
      tools::diagram({{"v", block("constant", {{"value", "12 V"}})},
                      {"e", block("constant", {{"value", "2 V"}})},
                      {"w", block("winding", {{"resistance", "4 ohm"}, {"inductance", "8 mH"}}, {"v", "e"})}},
                     {"w"}));
  SimulateOptions options;
  options.instants = {1e-3, 2e-3, 5e-3};
  const auto traces = simulate(*program, start(*program), options);
  for (std::size_t k = 0; k < 3; ++k)  // ten times the relative tolerance 1e-6
    EXPECT_NEAR(traces.values[0][k], 2.5 * (1 - std::exp(-options.instants[k] / 2e-3)), 3e-5);
}

TEST(VoiceCoilBlock, TakesFromTheSupplyHeatWorkAndWhatTheFieldKeeps) {
  const double r = 4, l = 8e-3, k = 12;
  const Bench b("voice_coil", {{"force_constant", {k}}, {"resistance", {r}}, {"inductance", {l}}});
  for (std::uint64_t t = 0; t < 20; ++t) {
    const double voltage = draw(t, 0, 10), velocity = draw(t, 1), i = draw(t, 2, 3);
    const double rate = b.derivative({voltage, velocity}, {i})[0], force = b.output(0, {voltage, velocity}, {i})[0];
    EXPECT_NEAR(voltage * i, r * i * i + l * i * rate + force * velocity, 1e-11);
  }
  EXPECT_FALSE(b.sizes.feedthrough);
}

const Bench::Values motor{
    {"resistance", {0.4}}, {"inductance_d", {2e-3}}, {"inductance_q", {3e-3}}, {"flux", {0.05}}, {"pole_pairs", {4}}};

TEST(SynchronousMotorBlock, TakesFromTheSupplyHeatWorkAndWhatTheFieldsKeep) {
  const Bench b("synchronous_motor", motor);
  for (std::uint64_t t = 0; t < 20; ++t) {
    const Numbers u{draw(t, 0, 10), draw(t, 1, 10), draw(t, 2, 100)}, i{draw(t, 3, 5), draw(t, 4, 5)};
    const Numbers rate = b.derivative(u, i), y = b.output(0, u, i);
    const double power = 1.5 * (u[0] * i[0] + u[1] * i[1]), heat = 1.5 * 0.4 * (i[0] * i[0] + i[1] * i[1]),
                 fields = 1.5 * (2e-3 * i[0] * rate[0] + 3e-3 * i[1] * rate[1]);
    EXPECT_NEAR(power, heat + fields + y[0] * u[2], 1e-10);  // numbers up to some thousand watts
    EXPECT_EQ(y[1], i[0]);
    EXPECT_EQ(y[2], i[1]);
  }
}

TEST(SynchronousMotorBlock, TorqueIsThatOfMagnetsAndReluctance) {
  const Bench b("synchronous_motor", motor);
  EXPECT_NEAR(b.output(0, {0, 0, 0}, {0, 6})[0], 1.5 * 4 * 0.05 * 6, 1e-14);
  EXPECT_NEAR(b.output(0, {0, 0, 0}, {-5, 6})[0], 1.5 * 4 * (0.05 * 6 + 1e-3 * 5 * 6), 1e-14);
}

TEST(SynchronousMotorBlock, StepsThroughLongRowsAsThroughShortOnes) {
  // Rows of ten time constants, 1000 rad/s electrical. 1e-7 of the way a sub-step, some 200 of them whose errors decay.
  const blocks::SynchronousMotor::Params<double> p{0.4, 2e-3, 3e-3, 0.05, 4};
  using In = blocks::SynchronousMotor::In<double>;
  blocks::SynchronousMotor::OwnStep step(p);
  const In from{1, -2, 200}, to{3, 5, 300};
  const double h = 50e-3;
  const auto coarse = step({0.3, -0.2}, from, to, h);
  blocks::SynchronousMotor::State<double> fine{0.3, -0.2};
  const int parts = 5000;
  for (int k = 0; k < parts; ++k) {
    const auto at = [&](int i) {
      const double s = static_cast<double>(i) / parts;
      return In{1 + 2 * s, -2 + 7 * s, 200 + 100 * s};
    };
    fine = step(fine, at(k), at(k + 1), h / parts);
  }
  EXPECT_NEAR(coarse.current_d, fine.current_d, 1e-5 * std::fabs(fine.current_d));
  EXPECT_NEAR(coarse.current_q, fine.current_q, 1e-5 * std::fabs(fine.current_q));
}

TEST(StepperMotorBlock, TakesFromTheSupplyHeatWorkAndWhatTheFieldsKeep) {
  const double r = 2, l = 4e-3, k = 0.3;
  const Bench b("stepper_motor", {{"resistance", {r}}, {"inductance", {l}}, {"torque_constant", {k}}});
  for (std::uint64_t t = 0; t < 20; ++t) {
    const Numbers u{draw(t, 0, 10), draw(t, 1, 10), draw(t, 2), draw(t, 3, 50)}, i{draw(t, 4, 3), draw(t, 5, 3)};
    const Numbers rate = b.derivative(u, i);
    const double power = u[0] * i[0] + u[1] * i[1], heat = r * (i[0] * i[0] + i[1] * i[1]),
                 fields = l * (i[0] * rate[0] + i[1] * rate[1]);
    EXPECT_NEAR(power, heat + fields + b.output(0, u, i)[0] * u[3], 1e-10);
  }
}

TEST(StepperMotorBlock, IsHeldByItsPhasesAQuarterOfAToothApart) {
  const Bench b("stepper_motor",
                {{"resistance", {2}}, {"inductance", {4e-3}}, {"torque_constant", {0.3}}, {"detent", {0.02}}});
  const double step = 2 * M_PI / 200;
  const auto torque = [&](double angle, double a, double of_b) { return b.output(0, {0, 0, angle, 0}, {a, of_b})[0]; };
  for (const double turn : {-1e-4, 1e-4}) {  // pushed back to where the currents hold it
    EXPECT_LT(torque(turn, 1, 0) * turn, 0);
    EXPECT_LT(torque(step + turn, 0, 1) * turn, 0);
    EXPECT_LT(torque(2 * step + turn, -1, 0) * turn, 0);
  }
  EXPECT_NEAR(torque(0, 1, 0), 0, 1e-15);
  EXPECT_NEAR(torque(step, 0, 1), 0, 1e-15);
  EXPECT_NEAR(torque(step / 8, 0, 0), -0.02 * std::sin(M_PI / 4), 1e-15);
}

TEST(StepperMotorBlock, StepsThroughLongRowsAsThroughShortOnes) {
  const blocks::StepperMotor::Params<double> p{2, 4e-3, 0.3, 50, 0};
  using In = blocks::StepperMotor::In<double>;
  blocks::StepperMotor::OwnStep step(p);
  const double h = 10e-3;  // five time constants, half a turn of the induced voltages
  const auto at = [&](double s) { return In{10 * s, 5, 6 * h * s, 6}; };
  const auto coarse = step({0.3, -0.2}, at(0), at(1), h);
  blocks::StepperMotor::State<double> fine{0.3, -0.2};
  const int parts = 2000;
  for (int k = 0; k < parts; ++k) fine = step(fine, at(double(k) / parts), at((k + 1.0) / parts), h / parts);
  EXPECT_NEAR(coarse.current_a, fine.current_a, 1e-5 * std::fabs(fine.current_a));
  EXPECT_NEAR(coarse.current_b, fine.current_b, 1e-5 * std::fabs(fine.current_b));
}

}  // namespace
}  // namespace hysteron
