#include "models/hysteresis/play.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/block/dual.h"
#include "models/math/saturation.h"
#include "models/random.h"

namespace hysteron {
namespace {

std::vector<double> wandering(double scale) {  // 500 moves without any order
  std::vector<double> u;
  for (std::uint64_t k = 0; k < 500; ++k) u.push_back(scale * random::normal(7, 0, k));
  return u;
}

TEST(PlayModel, TwoSidedPlayFollowsTheHandDrawnLoop) {
  // Radius 1, virgin: no move up to 1, then u - 1; turning at 3 it rests until u = 1, then u + 1.
  double w = 0;
  const double u[] = {0.5, 3, 2, 1, 0, -2, 0, 1};
  const double expected[] = {0, 2, 2, 2, 1, -1, -1, 0};
  for (int i = 0; i < 8; ++i) {
    w = play::follow(1.0, w, u[i]);
    EXPECT_EQ(w, expected[i]) << "move " << i;
  }
}

TEST(PlayModel, OneSidedPlayIsTheTwoSidedPlayOfHalfTheThresholdBehindAShift) {
  // OSP_r[u] = play_{r/2}[u - r/2] (SPEC 2.1). Both start where the identity holds: w = 0 = play with w = 0.
  const double r = 0.7;
  double one = 0, two = 0;
  for (const double u : wandering(2)) {
    one = play::follow_one_sided(r, one, u);
    two = play::follow(r / 2, two, u - r / 2);
    ASSERT_NEAR(one, two, 4e-15);  // a few roundings of numbers below 8
  }
}

TEST(PlayModel, AcceptingAPointDoesNotChangeTheOperatorThere) {
  double two = 0, one = 0;
  for (const double u : wandering(1)) {
    two = play::follow(0.3, two, u);
    one = play::follow_one_sided(0.3, one, u);
    ASSERT_EQ(play::follow(0.3, two, u), two);
    ASSERT_EQ(play::follow_one_sided(0.3, one, u), one);
  }
}

TEST(PlayModel, RateIsThatOfTheInputWhereItPullsAndZeroWhereItRests) {
  EXPECT_EQ(play::follow(Dual{1.0}, Dual{0.0}, Dual{3.0, 5.0}).rate, 5.0);
  EXPECT_EQ(play::follow(Dual{1.0}, Dual{0.0}, Dual{0.5, 5.0}).rate, 0.0);
  EXPECT_EQ(play::follow_one_sided(Dual{1.0}, Dual{0.0}, Dual{-2.0, 5.0}).rate, 5.0);
}

TEST(SaturationModel, LimitsAreReachedAndNotPassed) {
  EXPECT_EQ(saturation::limit(-1.0, 2.0, 5.0), 2.0);
  EXPECT_EQ(saturation::limit(-1.0, 2.0, -5.0), -1.0);
  EXPECT_EQ(saturation::limit(-1.0, 2.0, 0.5), 0.5);
  EXPECT_EQ(saturation::limit(Dual{-1.0}, Dual{2.0}, Dual{5.0, 3.0}).rate, 0.0);
  EXPECT_EQ(saturation::limit(Dual{-1.0}, Dual{2.0}, Dual{0.5, 3.0}).rate, 3.0);
}

}  // namespace
}  // namespace hysteron
