#include "models/sources/motion_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "engine/block/dual.h"

namespace hysteron {
namespace {

using namespace motion_profile;

constexpr double inf = std::numeric_limits<double>::infinity();
using Numbers = Limits<double>;

TEST(MotionProfileModel, ALongMoveTakesDistanceOverSpeedAndTheTimeOfSpeedingUp) {
  // 1 m at 0.5 m/s, 2 m/s^2, 40 m/s^3: t_j = 0.05 s, speeding up takes 0.5/2 + 0.05 = 0.3 s; in all 1/0.5 + 0.3 s.
  const auto m = move_of(1.0, Numbers{0.5, 2, 40});
  EXPECT_DOUBLE_EQ(m.jerk_time, 0.05);
  EXPECT_DOUBLE_EQ(m.even_time, 0.2);
  EXPECT_DOUBLE_EQ(m.cruise_time, 1.7);
  EXPECT_DOUBLE_EQ(m.duration(), 2.3);
  EXPECT_EQ(m.top_speed, 0.5);
  EXPECT_EQ(m.acceleration, 2);
}

TEST(MotionProfileModel, AMoveThatReachesNoSpeedLimit) {
  // 0.05 m: v_p (v_p/2 + 0.05) = 0.05, v_p = -0.05 + sqrt(0.0025 + 0.1) = 0.270156 m/s; no cruise.
  const auto m = move_of(-0.05, Numbers{0.5, 2, 40});
  const double top = -0.05 + std::sqrt(0.1025);
  EXPECT_NEAR(m.top_speed, top, 1e-16 * 10);
  EXPECT_EQ(m.cruise_time, 0);
  EXPECT_NEAR(m.duration(), 2 * (top / 2 + 0.05), 1e-15);
  EXPECT_EQ(m.acceleration, 2);
}

TEST(MotionProfileModel, AMoveThatReachesNoLimitButTheJerk) {
  // 2 j t_j^3 = d: 1 um at 40 m/s^3 is t_j = 2.3208e-3 s, four times that in all, the speed j t_j^2.
  const auto m = move_of(1e-6, Numbers{0.5, 2, 40});
  const double tj = std::cbrt(1e-6 / 80);
  EXPECT_NEAR(m.duration(), 4 * tj, 1e-16);
  EXPECT_NEAR(m.acceleration, 40 * tj, 1e-15);
  EXPECT_NEAR(m.top_speed, 40 * tj * tj, 1e-17 * 10);
}

TEST(MotionProfileModel, ASpeedThatIsReachedBeforeTheAcceleration) {
  // 0.02 m/s is reached within sqrt(0.02/40) s of jerk twice: 0.8944 m/s^2 of 2.
  const auto m = move_of(0.01, Numbers{0.02, 2, 40});
  const double tj = std::sqrt(0.02 / 40);
  EXPECT_NEAR(m.jerk_time, tj, 1e-17);
  EXPECT_EQ(m.even_time, 0);
  EXPECT_NEAR(m.acceleration, 40 * tj, 1e-15);
  EXPECT_NEAR(m.duration(), 0.01 / 0.02 + 2 * tj, 1e-15);
}

TEST(MotionProfileModel, WithoutALimitOfJerkTheVelocityIsATrapezoid) {
  const auto far = move_of(1.0, Numbers{0.5, 2, inf}), near = move_of(0.05, Numbers{0.5, 2, inf});
  EXPECT_DOUBLE_EQ(far.duration(), 1 / 0.5 + 0.5 / 2);
  EXPECT_DOUBLE_EQ(near.duration(), 2 * std::sqrt(0.05 / 2));
  EXPECT_EQ(near.acceleration, 2);
  EXPECT_DOUBLE_EQ(motion(near, 0.5 * near.duration(), 3).position, 0.025);
  EXPECT_DOUBLE_EQ(motion(near, 0.1, 1).velocity, 0.2);
}

TEST(MotionProfileModel, NoMoveTakesNoTime) { EXPECT_EQ(move_of(0.0, Numbers{1, 1, 1}).duration(), 0); }

/// Moves of all kinds: distances over ten decades, limits over four.
class RandomMoves : public testing::Test {
 protected:
  struct Case {
    Numbers limit;
    Move<double> move;
  };
  Case draw() {
    const auto spread = [&](double from, double to) {
      return from * std::pow(to / from, std::uniform_real_distribution<double>(0, 1)(random_));
    };
    const Numbers limit{spread(1e-2, 1e2), spread(1e-2, 1e2), random_() % 5 == 0 ? inf : spread(1e-1, 1e4)};
    return {limit, move_of((random_() % 2 == 0 ? 1 : -1) * spread(1e-8, 1e2), limit)};
  }
  static Move<Dual> with_rates(const Move<double>& m) {
    return {m.distance, m.jerk_time, m.even_time, m.cruise_time, m.acceleration, m.top_speed};
  }
  std::mt19937 random_{7};
};

TEST_F(RandomMoves, KeepEveryLimitAndReachOneOfThemAllTheTime) {
  int kinds[3] = {0, 0, 0};
  for (int i = 0; i < 3000; ++i) {
    const auto [limit, m] = draw();
    ++kinds[m.cruise_time > 0 ? 0 : m.even_time > 0 ? 1 : 2];
    const double rounding = 1 + 1e-14;
    double peak_speed = 0;
    for (int k = 0; k <= 400; ++k) {
      const double t = m.duration() * k / 400;
      const int piece = piece_of(m, t);
      const auto at = motion(m, t, piece);
      peak_speed = std::max(peak_speed, std::fabs(at.velocity));
      ASSERT_LE(std::fabs(at.velocity), limit.velocity * rounding);
      ASSERT_LE(std::fabs(at.acceleration), limit.acceleration * rounding);
      // The jerk: the slope of the acceleration, exactly that of the limit or none.
      const double jerk = motion(with_rates(m), Dual{t, 1}, piece).acceleration.rate;
      if (std::isinf(limit.jerk)) {
        ASSERT_EQ(jerk, 0);
      } else if (jerk != 0) {
        ASSERT_NEAR(std::fabs(jerk), limit.jerk, 1e-14 * limit.jerk * 10);
      }
    }
    const double middle = 0.5 * m.duration();
    EXPECT_NEAR(std::fabs(motion(m, middle, piece_of(m, middle)).velocity), m.top_speed, 1e-14 * m.top_speed);
    EXPECT_EQ(motion(m, m.duration(), Move<double>::corners - 1).position, m.distance);
  }
  for (const int kind : kinds) EXPECT_GT(kind, 200) << "each kind of move is tried";
}

TEST_F(RandomMoves, AreContinuousAtEveryCornerWithTheRatesThatTheyTell) {
  for (int i = 0; i < 1000; ++i) {
    const auto [limit, m] = draw();
    const auto corners = m.meeting();
    for (int c = 0; c < Move<double>::corners; ++c) {
      const double t = corners[static_cast<std::size_t>(c)];
      const auto before = motion(m, t, c - 1), behind = motion(m, t, c);
      // Rounding of times: a few 1e-16 of the duration, over what moves in it.
      const double of_time = 1e-14 * m.duration();
      ASSERT_NEAR(before.position, behind.position, of_time * m.top_speed) << i << " " << c;
      ASSERT_NEAR(before.velocity, behind.velocity, of_time * m.acceleration) << i << " " << c;
      if (!std::isinf(limit.jerk)) {
        ASSERT_NEAR(before.acceleration, behind.acceleration, of_time * limit.jerk) << i << " " << c;
      }
    }
    // dx/dt = v, dv/dt = a: by rates of the formulas themselves.
    const auto d = with_rates(m);
    for (int k = 0; k < 60; ++k) {
      const double t = m.duration() * (k + 0.5) / 60;
      const auto at = motion(d, Dual{t, 1}, piece_of(m, t));
      ASSERT_NEAR(at.position.rate, at.velocity.value, 1e-13 * m.top_speed);
      ASSERT_NEAR(at.velocity.rate, at.acceleration.value, 1e-13 * m.acceleration);
    }
  }
}

TEST(MotionProfileModel, SlopesAlongTheLimitsAreThoseOfDifferences) {
  for (const double distance : {1.0, 0.05, 1e-4}) {
    const auto at = [&](double h) {
      const auto m = move_of(distance, Numbers{0.5 + 0.3 * h, 2 - 0.7 * h, 40 + 9 * h});
      const double t = 0.4 * m.duration();
      return motion(m, t, piece_of(m, t));
    };
    const auto along = [](double value, double slope) {
      Jet j(value);
      j.slope[0] = slope;
      return j;
    };
    const auto m = move_of(Jet{distance}, Limits<Jet>{along(0.5, 0.3), along(2, -0.7), along(40, 9)});
    const auto plain_move = move_of(distance, Numbers{0.5, 2, 40});
    const auto slopes = motion(m, Jet{0.4} * m.duration(), piece_of(plain_move, 0.4 * plain_move.duration()));
    const double h = 1e-5;
    EXPECT_NEAR(slopes.position.slope[0], (at(h).position - at(-h).position) / (2 * h), 1e-8 * distance);
    EXPECT_NEAR(slopes.velocity.slope[0], (at(h).velocity - at(-h).velocity) / (2 * h), 1e-8);
  }
}

}  // namespace
}  // namespace hysteron
