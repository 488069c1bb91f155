// The functions of the scalar of lanes against those of the C library.
#include "engine/block/lane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace hysteron {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

/// Largest error relative to the result, over points from `from` to `to` that lie on no regular grid.
double worst(double from, double to, const std::function<double(double)>& ours,
             const std::function<double(double)>& theirs) {
  double largest = 0;
  for (int i = 0; i < 40000; ++i) {
    const double x = from + (to - from) * std::fmod(i * 0.6180339887498949, 1.0), right = theirs(x);
    if (right != 0) largest = std::fmax(largest, std::fabs(ours(x) / right - 1));
  }
  return largest;
}

// A unit in the last place is 2.2e-16 at most: a few of them for each.
TEST(Lane, TanhIsTheLibrarysToAFewUnitsInTheLastPlace) {
  const auto ours = [](double x) { return tanh(Lane(x)).v; };
  const auto theirs = [](double x) { return std::tanh(x); };
  EXPECT_LT(worst(-30, 30, ours, theirs), 1e-15);
  EXPECT_LT(worst(-1, 1, ours, theirs), 1e-15);
  EXPECT_LT(worst(-1e-6, 1e-6, ours, theirs), 1e-15);
  EXPECT_EQ(ours(infinity), 1);
  EXPECT_EQ(ours(-1e300), -1);
  EXPECT_EQ(ours(0), 0);
  EXPECT_TRUE(std::isnan(ours(nan)));
}

TEST(Lane, ExpIsTheLibrarysToAFewUnitsInTheLastPlace) {
  const auto ours = [](double x) { return exp(Lane(x)).v; };
  const auto theirs = [](double x) { return std::exp(x); };
  EXPECT_LT(worst(-707, 709, ours, theirs), 1e-15);
  EXPECT_LT(worst(-1, 1, ours, theirs), 1e-15);
  EXPECT_EQ(ours(0), 1);
  EXPECT_EQ(ours(-1e9), 0);
  EXPECT_EQ(ours(1e9), infinity);
  EXPECT_TRUE(std::isnan(ours(nan)));
}

TEST(Lane, LogIsTheLibrarysToAFewUnitsInTheLastPlace) {
  const auto ours = [](double x) { return log(Lane(x)).v; };
  const auto theirs = [](double x) { return std::log(x); };
  EXPECT_LT(worst(1e-3, 1e3, ours, theirs), 1e-15);
  EXPECT_LT(worst(0.999, 1.001, ours, theirs), 1e-15);
  EXPECT_LT(worst(1e299, 1e300, ours, theirs), 1e-15);
  for (const double x : {1e-310, 5e-324, 2.2250738585072014e-308}) EXPECT_NEAR(ours(x) / std::log(x), 1, 1e-15) << x;
  EXPECT_EQ(ours(1), 0);
  EXPECT_EQ(ours(0), -infinity);
  EXPECT_EQ(ours(infinity), infinity);
  EXPECT_TRUE(std::isnan(ours(-1)));
  EXPECT_TRUE(std::isnan(ours(nan)));
}

TEST(Lane, PowersOfWhatIsNotNegative) {
  const auto ours = [](double n) { return [n](double x) { return pow(Lane(x), n).v; }; };
  const auto theirs = [](double n) { return [n](double x) { return std::pow(x, n); }; };
  // |n ln x| of 14 carries 14 units of 1e-16 into the result, beside a few of exp
  for (const double n : {-2.0, 0.5, 1.0, 1.7, 3.0}) EXPECT_LT(worst(1e-2, 1e2, ours(n), theirs(n)), 4e-15) << n;
  for (const double n : {-2.0, 0.0, 0.5, 3.0}) EXPECT_EQ(ours(n)(0), std::pow(0, n)) << n;
  EXPECT_EQ(ours(0)(7), 1);
}

}  // namespace
}  // namespace hysteron
