// Tables: at the knots their values, between them what the papers say, over several axes one after the other.
#include "models/math/lookup.h"

#include <gtest/gtest.h>
#include <math.h>  // pchip.hpp calls isnan without std

#include <algorithm>
#include <array>
#include <boost/math/interpolators/pchip.hpp>
#include <vector>

namespace hysteron {
namespace {

using namespace lookup;
using Numbers = std::vector<double>;

double looked_up(Between between, Outside outside, const Numbers& x, const Numbers& y, double u) {
  std::vector<Axis<double>> axes{{x, u}};
  return value<double>(between, outside, axes, y);
}
const Numbers table_at{-1, 0, 0.5, 2, 3, 4.5}, table_values{1, 2, 2, -1, -1.5, 3};

TEST(LookupTable, IsItsValuesAtItsKnots) {
  for (const auto between : {Between::linear, Between::akima, Between::monotone})
    for (const auto outside : {Outside::clip, Outside::extrapolate, Outside::refuse})
      for (std::size_t i = 0; i < table_at.size(); ++i)
        EXPECT_NEAR(looked_up(between, outside, table_at, table_values, table_at[i]), table_values[i], 1e-15);
}

TEST(LookupTable, GoesStraightBetweenItsKnots) {
  EXPECT_DOUBLE_EQ(looked_up(Between::linear, Outside::clip, table_at, table_values, 0.25), 2);
  EXPECT_DOUBLE_EQ(looked_up(Between::linear, Outside::clip, table_at, table_values, 1.25), 0.5);
  EXPECT_DOUBLE_EQ(looked_up(Between::linear, Outside::clip, table_at, table_values, 4), 1.5);
}

TEST(LookupTable, BeyondItsEndsDoesWhatIsAsked) {
  EXPECT_DOUBLE_EQ(looked_up(Between::linear, Outside::clip, table_at, table_values, -9), 1);
  EXPECT_DOUBLE_EQ(looked_up(Between::linear, Outside::clip, table_at, table_values, 9), 3);
  EXPECT_DOUBLE_EQ(looked_up(Between::linear, Outside::extrapolate, table_at, table_values, -2), 0);
  EXPECT_DOUBLE_EQ(looked_up(Between::linear, Outside::extrapolate, table_at, table_values, 5.5), 6);
  EXPECT_TRUE(std::isnan(looked_up(Between::linear, Outside::refuse, table_at, table_values, 4.6)));
  EXPECT_TRUE(std::isnan(looked_up(Between::akima, Outside::refuse, table_at, table_values, -1.1)));
  for (const auto between : {Between::akima, Between::monotone}) {  // straight on with the slope at the end
    const double h = 1e-7, end = looked_up(between, Outside::extrapolate, table_at, table_values, 4.5);
    const double slope = (end - looked_up(between, Outside::extrapolate, table_at, table_values, 4.5 - h)) / h;
    EXPECT_NEAR(looked_up(between, Outside::extrapolate, table_at, table_values, 6.5), end + 2 * slope,
                1e-5);  // h times the curvature
  }
}

/// The monotone curve is that of Boost's pchip, another implementation of the same papers, away from the ends, where
/// that takes slopes of its own.
TEST(LookupTable, TheMonotoneCurveIsThatOfPchip) {
  const auto other = boost::math::interpolators::pchip<Numbers>(Numbers(table_at), Numbers(table_values));
  for (double u = 0; u < 3; u += 0.05)
    EXPECT_NEAR(looked_up(Between::monotone, Outside::clip, table_at, table_values, u), other(u), 1e-14) << u;
}

TEST(LookupTable, TheMonotoneCurveNeverLeavesItsValues) {
  for (double u = -1; u <= 4.5; u += 0.01) {
    const auto i = interval<double>(table_at, u);
    const double v = looked_up(Between::monotone, Outside::clip, table_at, table_values, u);
    EXPECT_GE(v, std::min(table_values[i], table_values[i + 1]) - 1e-14) << u;
    EXPECT_LE(v, std::max(table_values[i], table_values[i + 1]) + 1e-14) << u;
  }
}

/// Akima's formula worked out by hand: the secants are 1, 0, -2, -0.5, 3. At 0.5 the weights are |-0.5 + 2| = 1.5 and
/// |0 - 1| = 1, at 2 they are |3 + 0.5| = 3.5 and |-2 - 0| = 2.
TEST(LookupTable, TheCurveOfAkimaHasHisSlopes) {
  const double at_half = (1.5 * 0 + 1 * -2) / 2.5, at_two = (3.5 * -2 + 2 * -0.5) / 5.5;
  const double h = 1.5, s = 0.4, r = 0.6, u = 0.5 + s * h;
  const double right = r * r * ((1 + 2 * s) * 2 + s * h * at_half) + s * s * ((1 + 2 * r) * -1 - r * h * at_two);
  EXPECT_NEAR(looked_up(Between::akima, Outside::clip, table_at, table_values, u), right, 1e-14);
  // and he continues slopes straight at the ends: a parabola is kept, to its last interval
  const Numbers knots{0, 1, 2, 3, 4}, squares{0, 1, 4, 9, 16};
  for (double v = 0; v <= 4; v += 0.125)
    EXPECT_NEAR(looked_up(Between::akima, Outside::clip, knots, squares, v), v * v, 1e-13) << v;
}

TEST(LookupTable, OverSeveralAxesIsOneAfterTheOther) {
  // linear in each of three axes: every product of linear functions is met exactly
  const Numbers a{0, 1, 3}, b{-1, 2}, c{0, 0.5, 1, 4};
  Numbers table;
  const auto f = [](double u, double v, double w) { return (1 + 2 * u) * (3 - v) * (0.5 + w); };
  for (const double u : a)
    for (const double v : b)
      for (const double w : c) table.push_back(f(u, v, w));
  for (const auto [u, v, w] : {std::array{0.3, 0.1, 0.2}, std::array{2.9, -1.0, 3.9}, std::array{-1.0, 5.0, 7.0}}) {
    std::vector<Axis<double>> axes{{a, u}, {b, v}, {c, w}};
    EXPECT_NEAR(value<double>(Between::linear, Outside::extrapolate, axes, table), f(u, v, w),
                1e-12 * std::abs(f(u, v, w)));
  }
  std::vector<Axis<double>> outside{{a, 9.0}, {b, 0.5}, {c, 1.0}};
  EXPECT_NEAR(value<double>(Between::akima, Outside::clip, outside, table), f(3, 0.5, 1), 1e-12);
}

TEST(LookupTable, ItsKinkChangesItsSignAtEveryKnotWhereItBends) {
  for (const bool ends : {false, true}) {
    int changes = 0;
    double before = knot_kink({table_at, -2.013}, ends);
    for (double u = -2; u < 6; u += 0.007) {
      const double now = knot_kink({table_at, u}, ends);
      if (now * before < 0) {
        ++changes;
        EXPECT_TRUE(std::any_of(table_at.begin(), table_at.end(), [&](double k) { return k <= u && k > u - 0.0071; }))
            << u;
      }
      before = now;
    }
    EXPECT_EQ(changes, ends ? 6 : 4);
  }
}

}  // namespace
}  // namespace hysteron
