// Piecewise sources must name every corner once, strictly ahead, and pick the piece behind it there.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/blocks/bench.h"

namespace hysteron {
namespace {

using bench::Bench;

constexpr double never = std::numeric_limits<double>::infinity();

TEST(Breakpoints, OfATriangleAreItsTurningPoints) {
  for (const double f : {0.3, 7.1, 5.0}) {
    const Bench b("triangle", {{"amplitude", {3}}, {"offset", {3}}, {"frequency", {f}}, {"phase", {-M_PI / 2}}});
    double t = -1.234;
    double slope = b.output_rate(t, t, {}, {}, {})[0].rate;
    for (int k = 0; k < 2000; ++k) {
      const double breakpoint = b.next_breakpoint(t);
      ASSERT_GT(breakpoint, t);
      ASSERT_LE(breakpoint - t, 0.5 / f * (1 + 1e-9));
      // On the piece before the corner the slope is the old one, at the corner itself already the new one.
      const double middle = t + (breakpoint - t) / 2;
      ASSERT_EQ(b.output_rate(middle, middle, {}, {}, {})[0].rate, slope);
      const double turned = b.output_rate(breakpoint, breakpoint, {}, {}, {})[0].rate;
      ASSERT_NEAR(turned, -slope, 1e-12 * 12 * f);
      slope = turned;
      ASSERT_NEAR(std::fabs(slope), 12 * f, 1e-12 * 12 * f);
      // Both pieces meet there, at 0 or 6.
      const double before = b.output(breakpoint, middle, {}, {}, {})[0],
                   after = b.output(breakpoint, breakpoint, {}, {}, {})[0];
      ASSERT_NEAR(before, after, 1e-11);
      ASSERT_NEAR(std::fabs(before - 3), 3, 1e-11);
      t = breakpoint;
    }
    EXPECT_DOUBLE_EQ(b.shortest_period(), 0.5 / f);
  }
}

TEST(Breakpoints, OfAStepIsItsJump) {
  const Bench b("step", {{"before", {1}}, {"after", {2}}, {"time", {0.1}}});
  EXPECT_EQ(b.next_breakpoint(-5), 0.1);
  EXPECT_EQ(b.next_breakpoint(0.1), never);
  EXPECT_EQ(b.output(0.1)[0], 2) << "right-continuous";
  EXPECT_EQ(b.output(0.1, 0.05, {}, {}, {})[0], 1) << "the branch decides";
  EXPECT_EQ(b.sizes.smoothness, Smoothness::jumps);
}

TEST(Breakpoints, OfAStaircaseAreItsJumpsUpToTheLastLevel) {
  const Bench b("staircase", {{"levels", {0, 1, 2, 3}}, {"duration", {0.1}}});
  double t = -1;
  for (int k = 1; k <= 3; ++k) {
    t = b.next_breakpoint(t);
    EXPECT_NEAR(t, 0.1 * k, 1e-15);
    EXPECT_EQ(b.output(t)[0], k);
    EXPECT_EQ(b.output(t, std::nextafter(t, 0), {}, {}, {})[0], k - 1);
  }
  EXPECT_EQ(b.next_breakpoint(t), never);
  EXPECT_EQ(b.output(100)[0], 3);
  EXPECT_EQ(b.sizes.smoothness, Smoothness::jumps);
}

TEST(Breakpoints, OfAChirpAreTheEndsOfItsSweep) {
  const Bench b("chirp", {{"amplitude", {1}}, {"from", {1}}, {"to", {9}}, {"duration", {2}}});
  EXPECT_EQ(b.next_breakpoint(-1), 0);
  EXPECT_EQ(b.next_breakpoint(0), 2);
  EXPECT_EQ(b.next_breakpoint(2), never);
  EXPECT_DOUBLE_EQ(b.shortest_period(), 1.0 / 9);
}

TEST(Breakpoints, OfSensorNoiseAreItsSamples) {
  const Bench b("sensor_noise", {{"rms", {1}}, {"period", {0.1}}});
  double t = 0;
  for (int k = 0; k < 5000; ++k) {
    const double next = b.next_breakpoint(t);
    ASSERT_NEAR(next, 0.1 * (k + 1), 1e-12 * (k + 1));
    ASSERT_EQ(b.output(next, t, {0}, {}, {})[0], b.output(t, t, {0}, {}, {})[0]);
    ASSERT_NE(b.output(next, next, {0}, {}, {})[0], b.output(t, t, {0}, {}, {})[0]);
    t = next;
  }
}

TEST(Breakpoints, OfARecordingAreItsSamples) {
  Bench b("recorded", {});
  const Series series{{0, 0.5, 2}, {1, 3, 2}, Between::linear};
  b.series = &series;
  EXPECT_EQ(b.next_breakpoint(-1), 0);
  EXPECT_EQ(b.next_breakpoint(0), 0.5);
  EXPECT_EQ(b.next_breakpoint(0.5), 2);
  EXPECT_EQ(b.next_breakpoint(2), never);
}

}  // namespace
}  // namespace hysteron
