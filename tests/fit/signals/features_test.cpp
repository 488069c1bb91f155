// What is read off traces, against closed forms.
#include "fit/signals/features.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace hysteron::features {
namespace {

using std::numbers::pi;

TEST(Features, SizesOfAFewRows) {
  const std::vector<double> y{-3, 1, 2};
  EXPECT_EQ(stroke(y), 5);
  EXPECT_EQ(largest_size(y), 3);
  EXPECT_EQ(mean(y), 0);
  EXPECT_EQ(sum_of_squares(y), 14);
  EXPECT_DOUBLE_EQ(deviation(std::vector<double>{4, 8}), 2);
  EXPECT_DOUBLE_EQ(rms(y), std::sqrt(14.0 / 3));
}

TEST(Features, QuantilesLieOnStraightLinesBetweenTheValuesInOrder) {
  const std::vector<double> y{4, 1, 3, 2};
  EXPECT_EQ(quantile(y, 0), 1);
  EXPECT_DOUBLE_EQ(quantile(y, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile(y, 0.25), 1.75);
  EXPECT_EQ(quantile(y, 1), 4);
  EXPECT_EQ(quantile(std::vector<double>{}, 0.5), 0);
}

TEST(Features, MediansAreThoseOfTheRowsWithTheSameX) {
  const Medians m = medians(std::vector<double>{2, 1, 2, 1, 2}, std::vector<double>{10, 5, 30, 7, 20});
  EXPECT_EQ(m.x, (std::vector<double>{1, 2}));
  EXPECT_EQ(m.y, (std::vector<double>{6, 20}));
}

TEST(Features, TheKsDistanceIsTheLargestGapBetweenTheCumulativeShares) {
  const std::vector<double> a{1, 2, 3, 4}, b{1, 2, 3, 3.5}, c{5, 6};
  EXPECT_EQ(ks_distance(a, a), 0);
  EXPECT_EQ(ks_distance(a, c), 1);
  EXPECT_EQ(ks_distance(a, b), 0.25);  // between 3.5 and 4: 3/4 against 4/4
  EXPECT_EQ(ks_distance(std::vector<double>{1, 1, 1, 2}, std::vector<double>{1, 2, 2, 2}),
            0.5);  // equal values together
  EXPECT_EQ(ks_distance({}, c), 0);
}

TEST(Features, TheAreaOfALoopIsPositiveWhereTheOutputLags) {
  // y = sin(p - phi) over x = sin p encloses pi sin(phi): an ellipse. 4000 chords lose 2 pi^2 / (3 N^2) = 4e-7 of it.
  std::vector<double> x, lags, leads;
  for (int i = 0; i < 4000; ++i) {
    const double p = 2 * pi * i / 4000;
    x.push_back(std::sin(p));
    lags.push_back(100 + std::sin(p - 0.3));
    leads.push_back(100 + std::sin(p + 0.3));
  }
  EXPECT_NEAR(loop_area(x, lags), pi * std::sin(0.3), 1e-6);
  EXPECT_NEAR(loop_area(x, leads), -pi * std::sin(0.3), 1e-6);
}

TEST(Features, TheAreaOfAParallelogramIsExact) {
  const std::vector<double> x{0, 2, 4, 2}, y{0, 0, 1, 1};
  EXPECT_DOUBLE_EQ(loop_area(x, y), 2);
}

TEST(Features, RemanenceIsWhatIsLeftOverTheLargestValue) {
  EXPECT_DOUBLE_EQ(remanence(std::vector<double>{0, 8, 2}), 0.25);
  EXPECT_EQ(remanence(std::vector<double>{0, 0}), 0);
}

TEST(Features, AValueBetweenRowsLiesOnAStraightLineAndIsHeldBeyond) {
  const std::vector<double> t{0, 1, 3}, y{0, 10, 30};
  EXPECT_DOUBLE_EQ(value_at(t, y, 0.5), 5);
  EXPECT_DOUBLE_EQ(value_at(t, y, 1), 10);
  EXPECT_DOUBLE_EQ(value_at(t, y, -1), 0);
  EXPECT_DOUBLE_EQ(value_at(t, y, 9), 30);
}

TEST(Features, ASpectrumGivesAmplitudesAndLeavesTheMeanOut) {
  std::vector<double> y;
  for (int i = 0; i < 2000; ++i) {
    const double t = i * 1e-4;
    y.push_back(7 + 3 * std::sin(2 * pi * 5 * t) + 0.5 * std::cos(2 * pi * 150 * t + 1));
  }
  const Spectrum s = spectrum(y, 1e-4);
  ASSERT_EQ(s.frequency.size(), 1000U);
  EXPECT_DOUBLE_EQ(s.frequency[0], 5);
  // Sums of 2000 terms of size 10: rounding stays below 1e-12.
  EXPECT_NEAR(s.amplitude[0], 3, 1e-11);
  EXPECT_NEAR(line_above(s, 100), 0.5, 1e-11);
  EXPECT_NEAR(size_above(s, 100), 0.5, 1e-11);
  EXPECT_NEAR(size_above(s, 1), std::sqrt(9.25), 1e-11);
  EXPECT_NEAR(line_above(s, 200), 0, 1e-11);
}

TEST(Features, AHistogramCountsEveryRow) {
  const Histogram h = histogram(std::vector<double>{0, 1, 1, 2, 4}, 4);
  EXPECT_EQ(h.count, (std::vector<double>{1, 2, 1, 1}));
  EXPECT_EQ(h.middle, (std::vector<double>{0.5, 1.5, 2.5, 3.5}));
}

TEST(Features, AStepOvershootsAndSettlesAsTheSecondOrderLagDoes) {
  // y = 1 - exp(-d w t) (cos q t + d w/q sin q t), q = w sqrt(1 - d^2): overshoot exp(-pi d/sqrt(1 - d^2)) at t = pi/q.
  const double w = 100, d = 0.5, q = w * std::sqrt(1 - d * d);
  std::vector<double> t, y;
  for (int i = 0; i <= 5000; ++i) {
    t.push_back(1 + i * 1e-4);  // [s] counted from the first row
    const double s = t.back() - 1;
    y.push_back(2 - 2 * std::exp(-d * w * s) * (std::cos(q * s) + d * w / q * std::sin(q * s)));
  }
  EXPECT_NEAR(overshoot(y), std::exp(-std::numbers::pi * d / std::sqrt(1 - d * d)), 1e-5);  // rows of 1e-2/w: 1e-4^2/2
  const double found = settling(t, y, 0.02);
  // There it enters the band for good: on it, and never outside behind it.
  const double there = std::exp(-d * w * found) * (std::cos(q * found) + d * w / q * std::sin(q * found));
  EXPECT_NEAR(std::abs(there), 0.02, 1e-5);
  for (std::size_t i = 0; i < t.size(); ++i)
    EXPECT_TRUE(t[i] - 1 <= found || std::abs(y[i] - 2) / 2 <= 0.02 + 1e-9) << t[i];
  EXPECT_EQ(overshoot(std::vector<double>{0, -1, -2}), 0);
  EXPECT_DOUBLE_EQ(overshoot(std::vector<double>{0, -3, -2}), 0.5);
  EXPECT_EQ(settling(std::vector<double>{0, 1}, std::vector<double>{2, 2}, 0.02), 0);
}

}  // namespace
}  // namespace hysteron::features
