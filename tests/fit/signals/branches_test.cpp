#include "fit/signals/branches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/fit/lab.h"

namespace hysteron {
namespace {

std::vector<double> sine(std::size_t rows, double periods) {
  std::vector<double> u;
  for (std::size_t i = 0; i < rows; ++i)
    u.push_back(std::sin(2 * std::numbers::pi * periods * static_cast<double>(i) / static_cast<double>(rows)));
  return u;
}

TEST(TurningPoints, OfThreePeriodsOfASineAreItsSixExtremes) {
  const auto turns = turning_points(sine(300, 3), 0.02);
  ASSERT_EQ(turns.size(), 6U);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(static_cast<double>(turns[k]), 25 + 50 * static_cast<double>(k), 1);
}

TEST(TurningPoints, NoiseAndSmallStepsMakeNone) {
  auto u = sine(2000, 2);
  lab::Noise random(1);
  for (double& x : u) x = std::round((x + 0.01 * random()) / 0.02) * 0.02;
  EXPECT_EQ(turning_points(u, turning_threshold(u)).size(), 4U);
}

TEST(TurningPoints, AStartAtTheTopIsNoTurn) {
  std::vector<double> u;
  for (int i = 0; i < 100; ++i) u.push_back(1 - 0.01 * i);
  EXPECT_TRUE(turning_points(u, 0.02).empty());
  for (int i = 0; i < 100; ++i) u.push_back(0.01 * i);
  EXPECT_EQ(turning_points(u, 0.02).size(), 1U);
}

TEST(Branches, OfATrapezoidAreRiseHoldFall) {
  std::vector<double> u;
  for (int i = 0; i < 50; ++i) u.push_back(0.02 * i);
  for (int i = 0; i < 60; ++i) u.push_back(1);
  for (int i = 0; i < 50; ++i) u.push_back(1 - 0.02 * (i + 1));
  const auto b = branches(u);
  EXPECT_EQ(b[20], Branch::rising);
  EXPECT_EQ(b[80], Branch::hold);
  EXPECT_EQ(b[130], Branch::falling);
  long held = 0;
  for (const auto x : b) held += x == Branch::hold;
  EXPECT_EQ(held, 60);
}

TEST(Branches, OfANoisyHoldAreStillHold) {
  lab::Noise random(2);
  std::vector<double> u;
  for (int i = 0; i < 200; ++i) u.push_back(i < 100 ? 0.01 * i : 1.0);
  for (double& x : u) x += 1e-4 * random();
  const auto b = branches(u);
  long held = 0;
  for (std::size_t i = 105; i < 200; ++i) held += b[i] == Branch::hold;
  EXPECT_GT(held, 85);
  for (std::size_t i = 0; i < 95; ++i) EXPECT_EQ(b[i], Branch::rising) << i;
}

TEST(Branches, AQuickSineHasNoHold) {
  for (const auto b : branches(sine(1000, 10))) EXPECT_NE(b, Branch::hold);
}

TEST(FirstCycle, EndsWithItsSecondReversal) {
  EXPECT_NEAR(static_cast<double>(first_cycle_end(sine(400, 4))), 75, 1);
  EXPECT_EQ(first_cycle_end(std::vector<double>{0, 1, 2, 3}), 4U);  // no reversal: all of it is the first cycle
}

TEST(Roughness, IsTheNoiseOfASmoothSignalAndNearlyNothingWithoutNoise) {
  auto u = sine(5000, 5);
  EXPECT_LT(roughness(u), 1e-9);  // sixth difference of a sine of 1000 rows per period: (2 pi / 1000)^6 = 6e-14
  lab::Noise random(3);
  for (double& x : u) x += 0.01 * random();
  EXPECT_NEAR(roughness(u), 0.01, 0.0006);  // a median of 5000 correlated values: 3 % standard error
}

}  // namespace
}  // namespace hysteron
