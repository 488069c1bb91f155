// Dry friction beside a damping: closed forms at one speed and behind a turn, and the rate against the row.
#include "models/mechanics/bearing.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace hysteron::bearing_test {
namespace {

using bearing::Params;

/// By the rule of Runge and Kutta along a straight speed.
double by_rate(const Params<double>& p, double share, double from, double to, double h, int steps) {
  const double dt = h / steps;
  for (int i = 0; i < steps; ++i) {
    const auto speed = [&](double part) { return from + (to - from) * (i + part) / steps; };
    const double a = bearing::share_rate(p, share, speed(0));
    const double b = bearing::share_rate(p, share + dt / 2 * a, speed(0.5));
    const double c = bearing::share_rate(p, share + dt / 2 * b, speed(0.5));
    const double d = bearing::share_rate(p, share + dt * c, speed(1));
    share += dt / 6 * (a + 2 * b + 2 * c + d);
  }
  return share;
}

TEST(BearingModel, AtOneSpeedItTakesTheSlipDistanceToSlide) {
  const Params<double> p{.level = 2, .slip_distance = 0.3};
  for (const double t : {0.01, 0.1, 1.0})
    EXPECT_NEAR(bearing::share_after(p, 0, -0.7, -0.7, t), -(1 - std::exp(-0.7 * t / 0.3)), 1e-15) << t;
  // Turned at once: from sliding one way to sliding the other.
  EXPECT_NEAR(bearing::share_after(p, 1, -0.7, -0.7, 0.2), -1 + 2 * std::exp(-0.7 * 0.2 / 0.3), 1e-15);
}

TEST(BearingModel, BehindATurnWithinARowItComesBackAnotherWay) {
  const Params<double> p{.level = 2, .slip_distance = 0.3};
  // From 1 to -1 m/s in 2 s: half a metre out and back.
  const double out = 1 - std::exp(-0.5 / 0.3);
  EXPECT_NEAR(bearing::share_after(p, 0, 1, -1, 2), -1 + (1 + out) * std::exp(-0.5 / 0.3), 1e-15);
}

TEST(BearingModel, ARowIsWhatItsRateAddsUpTo) {
  const Params<double> p{.level = 2, .slip_distance = 0.3};
  // 4000 steps of order four: their error is far below 1e-12 but where the speed turns within a step: (5e-4)^2 there.
  for (const auto& [share, from, to] :
       {std::array{0.0, 0.2, 0.9}, {0.8, 0.5, -0.4}, {-0.6, -0.1, 0.7}, {1.0, -0.3, 0.0}, {0.4, 0.0, 0.0}})
    EXPECT_NEAR(bearing::share_after(p, share, from, to, 1.3), by_rate(p, share, from, to, 1.3, 4000), 1e-7) << from;
}

TEST(BearingModel, WhatSlidesWithinARowIsASignWhateverTheRow) {
  const Params<double> p{.level = 2, .slip_distance = 1e-9};
  EXPECT_DOUBLE_EQ(bearing::share_after(p, 0.2, 1, 2, 1), 1);
  EXPECT_DOUBLE_EQ(bearing::share_after(p, 1, 1, -2, 1), -1);
  EXPECT_EQ(bearing::share_after(p, 0.2, 0, 0, 1), 0.2) << "at rest it holds what it held";
}

TEST(BearingModel, BrakesAsTheDampingAndByTheCurveOfStribeck) {
  const Params<double> plain{.level = 2, .slip_distance = 0.3};
  EXPECT_DOUBLE_EQ(bearing::braking_speed(plain, 1.0, 5.0), 7);
  EXPECT_DOUBLE_EQ(bearing::braking_speed(plain, -1.0, -5.0), -7);
  const Params<double> falling{.level = 2, .slip_distance = 0.3, .excess = 0.5, .stribeck_velocity = 0.1};
  EXPECT_DOUBLE_EQ(bearing::braking_speed(falling, 1.0, 0.1), 0.1 + 2 * (1 + 0.5 * std::exp(-1.0)));
  EXPECT_DOUBLE_EQ(bearing::braking_speed(falling, 1.0, 5.0), 7) << "fast motion has none of the excess";
}

}  // namespace
}  // namespace hysteron::bearing_test
