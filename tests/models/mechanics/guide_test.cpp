// Friction of a guide without mass: closed forms, limits, and the rate against the step.
#include "models/mechanics/guide.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/hysteresis/play.h"
#include "models/mechanics/presliding.h"

namespace hysteron::guide_test {
namespace {

using guide::Params;

/// By small Euler steps of the rate; half a step's error per step.
double by_rate(const Params<double>& p, double share, double way, double h, int steps) {
  for (int i = 0; i < steps; ++i) share += h / steps * guide::share_rate(p, share, way / h);
  return share;
}

TEST(GuideModel, IsDahlsElementAlongTheWayOfTheMotionItself) {
  const Params<double> p{0.3, 0.2, 0, 1};
  // From rest by 0.7: y + level s = 0.7 with s = 1 - exp(-y/distance).
  const double share = guide::share_after(p, 0, 0.7, 1), y = 0.7 - 0.3 * share;
  EXPECT_NEAR(share, presliding::deflection_after(0.2, y) / 0.2, 1e-15);
  // Back by 0.5 from there.
  const double back = guide::share_after(p, share, -0.5, 1), y_back = 0.2 - 0.3 * back;
  EXPECT_NEAR(back, presliding::deflection_after(0.2, y_back - y, 0.2 * share) / 0.2, 1e-14);
}

TEST(GuideModel, ARowIsWhatItsRateAddsUpTo) {
  // 200 000 steps: their error, half a step times the curvature over the slip distance, is below 1e-5.
  for (const auto& [share, way] : {std::pair{0.0, 0.5}, {0.9, -0.8}, {-1.2, 0.3}, {1.3, 0.4}, {0.2, -1e-4}}) {
    const Params<double> p{0.15, 0.2, 0.4, 0.8};
    EXPECT_NEAR(guide::share_after(p, share, way, 0.6), by_rate(p, share, way, 0.6, 200000), 1e-5) << share << way;
  }
}

TEST(GuideModel, ARowMayBeCutAnywhere) {
  const Params<double> p{0.15, 0.2, 0.4, 0.8};
  const double half = guide::share_after(p, -0.7, 0.1, 0.2);
  EXPECT_NEAR(guide::share_after(p, half, 0.3, 0.6), guide::share_after(p, -0.7, 0.4, 0.8), 1e-14);
}

TEST(GuideModel, WithoutASlipDistanceIsAPlay) {
  // Sticks until the pull exceeds the friction: dry friction without presliding on an actuator is lost motion.
  const Params<double> p{0.3, 1e-7, 0, 1};
  double share = 0, w = 0, before = 0;
  for (const double u : {0.2, 1.0, 0.7, 0.1, -0.8, -0.5, 0.4}) {
    share = guide::share_after(p, share, u - before, 1);
    w = play::follow(0.3, w, u);
    EXPECT_NEAR(u - 0.3 * share, w, 3e-6) << u;  // some slip distances
    before = u;
  }
}

TEST(GuideModel, HoldsTheExcessWhileItSlidesSlowlyOnly) {
  const Params<double> p{0.1, 0.2, 0.5, 1};
  EXPECT_NEAR(guide::share_after(p, 0, 20, 20e3), 1.5, 1e-6);  // 1 mm/s: exp(-1e-6) of the excess
  EXPECT_NEAR(guide::share_after(p, 0, 20, 1), 1, 1e-12);      // 20 times the speed at which it is gone
  EXPECT_NEAR(guide::share_after(p, 0, 20, 20), 1 + 0.5 * std::exp(-1.0), 1e-12);
}

TEST(GuideModel, TakesEnergyInAClosedLoop) {
  const Params<double> p{0.15, 0.02, 0, 1};
  double share = 0, work = 0, y = 0, before = 0;
  const auto move_to = [&](double u) {
    const double next = guide::share_after(p, share, u - before, 1e-4), y_next = u - p.level * next;
    work += 0.5 * (share + next) * (y_next - y);  // what it holds times the way
    share = next;
    y = y_next;
    before = u;
  };
  constexpr int turn = 20000;
  for (int k = 0; k <= 3 * turn; ++k) {
    move_to(std::sin(k * 2 * 3.14159265358979 / turn));
    if (k == turn) work = 0;  // two whole turns behind the first
  }
  // Four ways of 2 less twice the level. Behind each turn it holds 1 - 2 exp(-way/distance): two distances less.
  // exp(-1.7/0.02) of it is not yet there; the trapezoids miss a twelfth of the square of a row, 3e-4, over a distance.
  EXPECT_NEAR(work, 4 * (2 - 2 * 0.15 - 2 * 0.02), 1e-5);
}

TEST(GuideModel, SaysWhereItWouldJump) {
  EXPECT_FALSE(guide::may_jump({0.3, 0.2, 0.5, 1}));
  EXPECT_TRUE(guide::may_jump({0.3, 0.2, 0.7, 1}));
  EXPECT_FALSE(guide::may_jump({3, 0.2, 0, 1})) << "without an excess never";
}

}  // namespace
}  // namespace hysteron::guide_test
