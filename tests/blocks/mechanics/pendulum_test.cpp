// Pendulum and propeller against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/blocks/samples.h"
#include "tests/engine/simulate_tools.h"

namespace hysteron {
namespace {

using bench::Bench;
using tools::block;

const bench::Samples pendulum_and_propeller{
    {"pendulum", {{"mass", {2}}, {"length", {0.5}}, {"inertia", {0.3}}, {"damping", {0.2}}, {"initial_angle", {0.4}}}},
    {"propeller", {{"thrust_coefficient", {0.7}}, {"torque_coefficient", {0.1}}, {"time", {0.3}}}}};

TEST(PendulumBlock, SwingsWideInTheTimeOfTheEllipticIntegral) {
  // A quarter of the period: sqrt(J/(m g l)) K(sin(angle/2)), where it hangs straight down.
  for (const double angle : {0.1, 1.0, 2.5}) {
    const auto pendulum = block("pendulum",
                                {{"mass", "2 kg"},
                                 {"length", "0.5 m"},
                                 {"inertia", "0.3 kg m^2"},
                                 {"initial_angle", fmt::format("{:.17g} rad", angle)}},
                                {"t"});
    const auto program =
        tools::compiled(tools::diagram({{"t", block("constant", {{"value", "0 N*m"}})}, {"p", pendulum}}, {"p.angle"}));
    const double quarter = std::sqrt((0.3 + 2 * 0.25) / (2 * 9.80665 * 0.5)) * std::comp_ellint_1(std::sin(angle / 2));
    SimulateOptions options;
    options.instants = {quarter, 2 * quarter, 4 * quarter};
    options.relative_tolerance = 1e-8;
    const auto angles = simulate(*program, start(*program), options).values[0];
    EXPECT_NEAR(angles[0], 0, 1e-5);
    EXPECT_NEAR(angles[1], -angle, 1e-5);
    EXPECT_NEAR(angles[2], angle, 1e-5);
  }
}

TEST(PendulumBlock, RestsWhereGravityHoldsTheTorque) {
  const Bench b("pendulum", {{"mass", {2}}, {"length", {0.5}}});
  EXPECT_NEAR(b.rest({3})[0], std::asin(3 / 9.80665), 1e-15);
  EXPECT_TRUE(std::isnan(b.rest({20})[0])) << "it turns over";
  EXPECT_NEAR(b.derivative({0}, {M_PI, 0})[1], 0, 1e-14) << "upright";
}

TEST(PropellerBlock, ThrustsByTheSquareOfASpeedThatLags) {
  const Bench b("propeller", {{"thrust_coefficient", {2e-5}}, {"torque_coefficient", {3e-7}}, {"time", {0.05}}});
  EXPECT_NEAR(b.output(0, {0}, {400})[0], 3.2, 1e-13);
  EXPECT_NEAR(b.output(0, {0}, {-400})[0], -3.2, 1e-13);
  EXPECT_NEAR(b.output(0, {0}, {400})[1], 0.048, 1e-15);
  EXPECT_NEAR(b.derivative({500}, {400})[0], 100 / 0.05, 1e-10);
  EXPECT_EQ(b.rest({500})[0], 500);
}

}  // namespace
}  // namespace hysteron
