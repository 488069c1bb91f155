// The bent drive of operators: a rising curve through both ends of its range.
#include "models/hysteresis/curved_drive.h"

#include <gtest/gtest.h>

namespace hysteron::curved_drive {
namespace {

TEST(CurvedDrive, IsTheStraightLineWhereBothSlopesAreOne) {
  const Params<double> p{-2, 6, 1, 1};
  for (const double u : {-5.0, -2.0, -0.3, 0.0, 1.7, 6.0, 9.0}) EXPECT_NEAR(curved(p, u), u, 4e-15) << u;
}

TEST(CurvedDrive, KeepsTheRangeAndIsZeroAtZero) {
  for (const double lower : {-3.0, 0.0, 1.5}) {
    const Params<double> p{lower, 8, 0.3, 1.9};
    EXPECT_EQ(curved(p, 0.0), 0);
    EXPECT_NEAR(curved(p, 8.0) - curved(p, lower), 8 - lower, 4e-15) << lower;
  }
}

TEST(CurvedDrive, HasTheSlopesThatItIsGivenThereAndBeyond) {
  const Params<double> p{1, 3, 0.4, 2.2};
  const auto slope = [&](double u) { return (curved(p, u + 1e-6) - curved(p, u - 1e-6)) / 2e-6; };
  // The second derivative jumps at the ends: half of it, at most 6/range, times the step.
  EXPECT_NEAR(slope(1), 0.4, 1e-5);
  EXPECT_NEAR(slope(3), 2.2, 1e-5);
  EXPECT_NEAR(slope(-4), 0.4, 1e-8);
  EXPECT_NEAR(slope(7), 2.2, 1e-8);
  // In the middle a cubic of Hermite is 1.5 less a quarter of both.
  EXPECT_NEAR(slope(2), 1.5 - (0.4 + 2.2) / 4, 1e-8);
}

TEST(CurvedDrive, RisesForAllSlopesUpToThree) {
  for (double a = 0; a <= 3; a += 0.5)
    for (double b = 0; b <= 3; b += 0.5) {
      const Params<double> p{0, 1, a, b};
      for (int i = 0; i < 1000; ++i)  // rounding of numbers up to three
        EXPECT_GE(curved(p, (i + 1) / 1000.0), curved(p, i / 1000.0) - 1e-15) << a << " " << b << " " << i;
    }
}

}  // namespace
}  // namespace hysteron::curved_drive
