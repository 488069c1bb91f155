// Piecewise sources must name every corner once, strictly ahead, and pick the piece behind it there.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/blocks/bench.h"

namespace hysteron {
namespace {

using bench::Bench;

constexpr double never = std::numeric_limits<double>::infinity();

TEST(Corners, OfATriangleAreItsTurningPoints) {
  for (const double f : {0.3, 7.1, 5.0}) {
    const Bench b("triangle", {{"amplitude", {3}}, {"offset", {3}}, {"frequency", {f}}, {"phase", {-M_PI / 2}}});
    double t = -1.234;
    double slope = b.output_rate(t, t, {}, {}, {})[0].rate;
    for (int k = 0; k < 2000; ++k) {
      const double corner = b.next_corner(t);
      ASSERT_GT(corner, t);
      ASSERT_LE(corner - t, 0.5 / f * (1 + 1e-9));
      // On the piece before the corner the slope is the old one, at the corner itself already the new one.
      const double middle = t + (corner - t) / 2;
      ASSERT_EQ(b.output_rate(middle, middle, {}, {}, {})[0].rate, slope);
      const double turned = b.output_rate(corner, corner, {}, {}, {})[0].rate;
      ASSERT_NEAR(turned, -slope, 1e-12 * 12 * f);
      slope = turned;
      ASSERT_NEAR(std::fabs(slope), 12 * f, 1e-12 * 12 * f);
      // Both pieces meet there, at 0 or 6.
      const double before = b.output(corner, middle, {}, {}, {})[0], after = b.output(corner, corner, {}, {}, {})[0];
      ASSERT_NEAR(before, after, 1e-11);
      ASSERT_NEAR(std::fabs(before - 3), 3, 1e-11);
      t = corner;
    }
    EXPECT_DOUBLE_EQ(b.pace(), 0.5 / f);
  }
}

TEST(Corners, OfAStepIsItsJump) {
  const Bench b("step", {{"before", {1}}, {"after", {2}}, {"time", {0.1}}});
  EXPECT_EQ(b.next_corner(-5), 0.1);
  EXPECT_EQ(b.next_corner(0.1), never);
  EXPECT_EQ(b.output(0.1)[0], 2) << "right-continuous";
  EXPECT_EQ(b.output(0.1, 0.05, {}, {}, {})[0], 1) << "the branch decides";
  EXPECT_EQ(b.sizes.smoothness, Smoothness::jumps);
}

TEST(Corners, OfAStaircaseAreItsJumpsUpToTheLastLevel) {
  const Bench b("staircase", {{"levels", {0, 1, 2, 3}}, {"duration", {0.1}}});
  double t = -1;
  for (int k = 1; k <= 3; ++k) {
    t = b.next_corner(t);
    EXPECT_NEAR(t, 0.1 * k, 1e-15);
    EXPECT_EQ(b.output(t)[0], k);
    EXPECT_EQ(b.output(t, std::nextafter(t, 0), {}, {}, {})[0], k - 1);
  }
  EXPECT_EQ(b.next_corner(t), never);
  EXPECT_EQ(b.output(100)[0], 3);
  EXPECT_EQ(b.sizes.smoothness, Smoothness::jumps);
}

TEST(Corners, OfAChirpAreTheEndsOfItsSweep) {
  const Bench b("chirp", {{"amplitude", {1}}, {"from", {1}}, {"to", {9}}, {"duration", {2}}});
  EXPECT_EQ(b.next_corner(-1), 0);
  EXPECT_EQ(b.next_corner(0), 2);
  EXPECT_EQ(b.next_corner(2), never);
  EXPECT_DOUBLE_EQ(b.pace(), 1.0 / 9);
}

TEST(Corners, OfSensorNoiseAreItsSamples) {
  const Bench b("sensor_noise", {{"rms", {1}}, {"period", {0.1}}});
  double t = 0;
  for (int k = 0; k < 5000; ++k) {
    const double next = b.next_corner(t);
    ASSERT_NEAR(next, 0.1 * (k + 1), 1e-12 * (k + 1));
    ASSERT_EQ(b.output(next, t, {0}, {}, {})[0], b.output(t, t, {0}, {}, {})[0]);
    ASSERT_NE(b.output(next, next, {0}, {}, {})[0], b.output(t, t, {0}, {}, {})[0]);
    t = next;
  }
}

TEST(Corners, OfARecordingAreItsSamples) {
  Bench b("recorded", {});
  const Series series{{0, 0.5, 2}, {1, 3, 2}, Between::linear};
  b.series = &series;
  EXPECT_EQ(b.next_corner(-1), 0);
  EXPECT_EQ(b.next_corner(0), 0.5);
  EXPECT_EQ(b.next_corner(0.5), 2);
  EXPECT_EQ(b.next_corner(2), never);
}

}  // namespace
}  // namespace hysteron
