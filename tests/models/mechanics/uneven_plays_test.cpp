// Plays that are not equally strong everywhere, against closed forms and against their own rates.
#include "models/mechanics/uneven_plays.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/hysteresis/play.h"
#include "models/random.h"

namespace hysteron {
namespace {

using uneven_plays::Range;
using uneven_plays::Strength;

const Range<double> range{-2, 3};

TEST(UnevenPlays, AnEvenStrengthPassesOnInProportion) {
  for (const double w : {-7.0, -2.0, -0.3, 0.0, 1.9, 3.0, 11.0})
    EXPECT_NEAR(uneven_plays::passed_on(range, {5.0, 5.0, 5.0}, w), 5 * w, 1e-13) << w;
}

TEST(UnevenPlays, WhatIsPassedOnIsTheIntegralOfTheStrength) {
  const Strength<double> s{4, 0.5, 7};
  EXPECT_EQ(uneven_plays::passed_on(range, s, 0.0), 0);
  // All of the range: a third of the sum, times its length (Bernstein's parabolas have one area).
  EXPECT_NEAR(uneven_plays::passed_on(range, s, 3.0) - uneven_plays::passed_on(range, s, -2.0), 5 * 11.5 / 3, 1e-13);
  for (const double w : {-3.0, -1.9, -0.4, 0.5, 2.0, 2.9, 4.0}) {
    const double h = 1e-4;  // the integral is a cubic: its central difference is off by h^2 times 1, rounding by 1e-12
    const double slope =
        (uneven_plays::passed_on(range, s, w + h) - uneven_plays::passed_on(range, s, w - h)) / (2 * h);
    EXPECT_NEAR(slope, uneven_plays::strength(range, s, w), 1e-7) << w;
  }
  EXPECT_EQ(uneven_plays::strength(range, s, -2.5), 4) << "beyond the range it stays as at its end";
  EXPECT_EQ(uneven_plays::strength(range, s, 3.5), 7);
  EXPECT_EQ(uneven_plays::strength(range, s, 0.5), 4.0 / 4 + 0.5 / 2 + 7.0 / 4) << "in the middle";
}

TEST(UnevenPlays, OnePlayWhoseNumbersStayPassesOnTheSame) {
  const Strength<double> s{4, 0.5, 7};
  const uneven_plays::PassedOn one(range, s);
  EXPECT_EQ(one(0.0), 0);
  for (const double w : {-7.0, -2.0, -1.9, 0.5, 2.9, 3.0, 11.0})
    EXPECT_NEAR(one(w), uneven_plays::passed_on(range, s, w), 1e-13) << w;  // rounding of 77
  const uneven_plays::PassedOn above(Range<double>{1, 2}, s);
  EXPECT_NEAR(above(1.5), uneven_plays::passed_on(Range<double>{1, 2}, s, 1.5), 1e-14) << "0 lies beyond the range";
}

TEST(UnevenPlays, BehindAMoveStandsWhatTheRateSays) {
  const double radius = 0.4;
  double w = 0, u = 0;
  for (std::uint64_t move = 0; move < 60; ++move) {
    const double to = 0.8 * random::normal(7, 0, move);
    const double expected = uneven_plays::after(radius, w, u, to);
    // Heun's steps along the way, of which the corner (a fiftieth of the unit) has two thousand at least.
    const int steps = 200000;
    const double h = (to - u) / steps;
    for (int i = 0; i < steps; ++i) {
      const double now = u + h * i, first = uneven_plays::rate(radius, w, now, h);
      w += 0.5 * (first + uneven_plays::rate(radius, w + first, now + h, h));
    }
    EXPECT_NEAR(w, expected, 1e-6) << move;
    w = expected;
    u = to;
  }
}

TEST(UnevenPlays, APlayIsOneWhoseCornerIsRound) {
  const double radius = 0.4, corner = uneven_plays::corner * radius;
  EXPECT_EQ(uneven_plays::after(radius, 0, 0, radius - corner), 0) << "before it is touched";
  const double far = 2;  // 80 corners behind
  EXPECT_NEAR(uneven_plays::after(radius, 0, 0, far), play::follow(radius, 0.0, far), 1e-15);
  EXPECT_NEAR(uneven_plays::after(radius, 0, 0, -far), play::follow(radius, 0.0, -far), 1e-15);
  EXPECT_NEAR(uneven_plays::after(radius, 0, 0, radius), corner / std::exp(1), 1e-15) << "it was touched a corner ago";
  // One way or two in the same direction.
  const double half_way = uneven_plays::after(radius, 0, 0, 0.39);
  EXPECT_NEAR(uneven_plays::after(radius, half_way, 0.39, 0.5), uneven_plays::after(radius, 0, 0, 0.5), 1e-15);
}

TEST(UnevenPlays, ASpringThatTheySoftenGivesNoEnergyBack) {
  // Force k x - passed on: around any closed way it takes energy where strengths are not negative.
  const Strength<double> s{4, 0.5, 7};
  double w = 0, x = 0, work = 0;
  const auto go = [&](double to) {
    const double from = x;
    for (int i = 1; i <= 20000; ++i) {
      const double next = from + (to - from) * i / 20000, before = -uneven_plays::passed_on(range, s, w);
      w = uneven_plays::after(0.3, w, x, next);
      work += 0.5 * (before - uneven_plays::passed_on(range, s, w)) * (next - x);
      x = next;
    }
  };
  go(2);
  go(-1.5);
  work = 0;
  go(2);
  go(-1.5);
  // The play stands 0.3 behind each way: an area of twice that, times what it passes on between -1.2 and 1.7. What the
  // round corners take off that is less than a corner, 0.015, at each end times the strength there.
  const double between = uneven_plays::passed_on(range, s, 1.7) - uneven_plays::passed_on(range, s, -1.2);
  EXPECT_NEAR(work, 0.6 * between, 2 * 0.015 * 0.6 * 7);
  EXPECT_GT(work, 0);
}

}  // namespace
}  // namespace hysteron
