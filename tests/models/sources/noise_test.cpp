#include "models/sources/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/block/dual.h"

namespace hysteron {
namespace {

double sinc(double x) { return std::sin(std::numbers::pi * x) / (std::numbers::pi * x); }

TEST(NoiseModel, TheBandwidthsAreThoseOfHalfThePower) {
  EXPECT_NEAR(std::pow(sinc(noise::held_bandwidth), 2), 0.5, 1e-14);
  EXPECT_NEAR(std::pow(sinc(noise::joined_bandwidth), 8), 0.5, 1e-14);
}

TEST(NoiseModel, JoinedNumbersAreContinuousWithTwoRates) {
  for (int k = -3; k < 200; ++k) {
    const auto at = [&](double e) { return noise::joined(k + e, 5, 2); };
    const double e = 1e-4;
    ASSERT_NEAR(at(-1e-13), at(0), 1e-12);
    ASSERT_NEAR((at(0) - at(-e)) / e, (at(e) - at(0)) / e, 5e-3);  // second rate times e: some ten at most
    ASSERT_NEAR(noise::joined(Dual{k + 0.3, 1}, 5, 2).rate, (at(0.3 + e) - at(0.3 - e)) / (2 * e), 1e-6);
    ASSERT_NEAR((at(0) - 2 * at(-e) + at(-2 * e)) / (e * e), (at(2 * e) - 2 * at(e) + at(0)) / (e * e), 2e-2);
  }
}

TEST(NoiseModel, MeanSquareAndCorrelationAreThoseOfTheSplines) {
  // Correlation at a distance of whole numbers d: the B-spline of order 8 at d, over its value at 0: 1191/2416,
  // 120/2416, 1/2416. Means over 20 samples a number of n = 40 000 numbers: five standard errors, of sqrt(2 sum
  // rho^2/n).
  const int n = 40000, per = 20;
  const double rho[] = {1, 1191.0 / 2416, 120.0 / 2416, 1.0 / 2416, 0};
  double sums[5] = {};
  for (int i = 0; i < n * per; ++i)
    for (int d = 0; d < 5; ++d)
      sums[d] +=
          noise::joined(static_cast<double>(i) / per, 3, 1) * noise::joined(static_cast<double>(i) / per + d, 3, 1);
  const double error = std::sqrt(2 * (1 + 2 * (rho[1] * rho[1] + rho[2] * rho[2])) / n);
  for (int d = 0; d < 5; ++d) EXPECT_NEAR(sums[d] / (n * per), rho[d], 5 * error) << d;
}

TEST(NoiseModel, NothingIsLeftFarAboveTheBandwidth) {
  // Power in bins of a discrete transform of 4096 numbers' length, 16 samples each: beyond five bandwidths, 1.14/T,
  // less than 1e-4 of the whole; below half of the bandwidth the density is flat: 2 T/mean_square (0.84 at the half).
  const int n = 2048, per = 16, samples = n * per;
  std::vector<double> y;
  for (int i = 0; i < samples; ++i) y.push_back(noise::joined(static_cast<double>(i) / per, 9, 4));
  const auto power = [&](int bin) {
    double re = 0, im = 0;
    for (int i = 0; i < samples; ++i) {
      const double phase = 2 * std::numbers::pi * bin * i / samples;
      re += y[static_cast<std::size_t>(i)] * std::cos(phase);
      im += y[static_cast<std::size_t>(i)] * std::sin(phase);
    }
    return 2 * (re * re + im * im) / (static_cast<double>(samples) * samples);
  };
  const double bandwidth = noise::joined_bandwidth * n;  // in bins
  double low = 0, high = 0;
  const int width = 60;
  for (int b = 0; b < width; ++b) {
    low += power(20 + b);
    high += power(static_cast<int>(5 * bandwidth) + b);
  }
  const double flat = 2.0 / noise::mean_square / n;  // of a bin, in squares of the unit
  EXPECT_NEAR(low / width, flat, 5 * flat / std::sqrt(width))
      << "each bin is chi-squared of two: its own size uncertain";
  EXPECT_LT(high, 1e-4 * low);
}

}  // namespace
}  // namespace hysteron
