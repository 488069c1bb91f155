#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/blocks/bench.h"

namespace hysteron {
namespace {

using bench::Bench;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double cubic(double t) { return 1 + 2 * t - 3 * t * t + 0.5 * t * t * t; }
double cubic_rate(double t) { return 2 - 6 * t + 1.5 * t * t; }

History cubic_history() {
  History h;
  for (const double t : {0.0, 0.1, 0.4, 1.1, 1.2}) {
    h.t.push_back(t);
    h.u.push_back(cubic(t));
    h.rate.push_back(cubic_rate(t));
  }
  h.before = cubic(0);
  return h;
}

Bench delayed(const History& h, double delay) {
  Bench b("dead_time", {{"delay", {delay}}});
  b.history = &h;
  return b;
}

TEST(DeadTimeBlock, ReproducesACubicExactlyBetweenPointsWithRates) {
  const History h = cubic_history();
  const Bench b = delayed(h, 0.25);
  for (double t = 0.26; t < 1.44; t += 0.013) {
    const Dual y = b.output_rate(t, t, {}, {}, {})[0];
    EXPECT_NEAR(y.value, cubic(t - 0.25), 1e-14);
    EXPECT_NEAR(y.rate, cubic_rate(t - 0.25), 1e-13);
    EXPECT_EQ(b.output(t)[0], y.value);
  }
}

TEST(DeadTimeBlock, IsAtRestBeforeTheStart) {
  const History h = cubic_history();
  const Bench b = delayed(h, 0.25);
  EXPECT_EQ(b.output(0.1)[0], cubic(0));
  EXPECT_EQ(b.output_rate(0.1, 0.1, {}, {}, {})[0].rate, 0);
}

TEST(DeadTimeBlock, GoesStraightOnBehindTheLastAcceptedPoint) {
  const History h = cubic_history();
  const Dual y = delayed(h, 0.01).output_rate(1.26, 1.26, {}, {}, {})[0];
  EXPECT_NEAR(y.value, cubic(1.2) + 0.05 * cubic_rate(1.2), 1e-14);
  EXPECT_NEAR(y.rate, cubic_rate(1.2), 1e-14);
}

TEST(DeadTimeBlock, JoinsPointsWithoutRatesByStraightLines) {
  const History h{{0, 1, 2}, {0, 4, 2}, {unknown, unknown, unknown}, 0, 0};
  EXPECT_EQ(delayed(h, 1).output(1.5)[0], 2);
  EXPECT_EQ(delayed(h, 1).output(2.5)[0], 3);
  EXPECT_EQ(delayed(h, 0).output(5)[0], 2) << "no rate, no slope behind the end";
}

TEST(DeadTimeBlock, KeepsACornerSharpThatStandsTwiceInTheHistory) {
  // Rising with slope 1 until t = 1, falling with slope -2 from there: both slopes are remembered at the corner.
  const History h{{0, 1, 1, 2}, {0, 1, 1, -1}, {1, 1, -2, -2}, 0, 0};
  const Bench b = delayed(h, 0.5);
  for (double t = 0.55; t < 2.45; t += 0.1) {
    const double s = t - 0.5;
    EXPECT_NEAR(b.output(t)[0], s < 1 ? s : 1 - 2 * (s - 1), 1e-15);
  }
  EXPECT_EQ(b.output_rate(1.5, 1.49, {}, {}, {})[0].rate, 1) << "the branch decides";
  EXPECT_EQ(b.output_rate(1.5, 1.51, {}, {}, {})[0].rate, -2);
}

TEST(DeadTimeBlock, KeepsAJumpThatStandsTwiceInTheHistory) {
  const History h{{0, 1, 1, 2}, {0, 0, 5, 5}, {0, 0, 0, 0}, 0, 0};
  const Bench b = delayed(h, 0.5);
  EXPECT_EQ(b.output(1.5, 1.4, {}, {}, {})[0], 0);
  EXPECT_EQ(b.output(1.5, 1.5, {}, {}, {})[0], 5);
}

TEST(DeadTimeBlock, SaysWhatItNeedsOfTheEngine) {
  const Bench b("dead_time", {{"delay", {0.25}}});
  EXPECT_TRUE(b.sizes.history);
  EXPECT_FALSE(b.sizes.feedthrough);
  View<double> v;
  v.p = b.p.data();
  v.p_at = b.p_at.data();
  EXPECT_EQ(b.kernel.reach_back(v), 0.25);
}

TEST(DeadTimeBlock, ForgottenPointsDoNotCount) {
  History h = cubic_history();
  h.first = 2;
  const Bench b = delayed(h, 0);
  EXPECT_NEAR(b.output(0.7)[0], cubic(0.7), 1e-14);
}

}  // namespace
}  // namespace hysteron
