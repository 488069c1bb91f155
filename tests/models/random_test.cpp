#include "models/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hysteron {
namespace {

TEST(RandomModel, MixingIsThatOfSplitMix64) {
  // First output of the published reference for seed 0 (prng.di.unimi.it/splitmix64.c): increment, then mix.
  EXPECT_EQ(random::mix(0x9e3779b97f4a7c15ULL), 0xe220a8397b1dcdafULL);
}

TEST(RandomModel, NumbersDependOnSeedStreamAndIndexOnly) {
  const double a = random::normal(1, 2, 3);
  random::normal(1, 2, 4);
  EXPECT_EQ(random::normal(1, 2, 3), a);
  EXPECT_NE(random::normal(2, 2, 3), a);
  EXPECT_NE(random::normal(1, 3, 3), a);
  EXPECT_NE(random::normal(1, 2, 4), a);
}

TEST(RandomModel, NormalNumbersHaveMeanZeroVarianceOneAndNormalTails) {
  const int n = 100000;
  double sum = 0, squares = 0, neighbours = 0, before = 0;
  int beyond_two = 0;
  for (int k = 0; k < n; ++k) {
    const double x = random::normal(42, 0, static_cast<std::uint64_t>(k));
    sum += x;
    squares += x * x;
    neighbours += x * before;
    before = x;
    if (std::fabs(x) > 2) ++beyond_two;
  }
  // Five standard errors: 5/sqrt(n) for the mean and the correlation, 5 sqrt(2/n) for the variance; beyond two sigma
  // lie 4.550 %, give or take 5 sqrt(0.0455/n).
  EXPECT_NEAR(sum / n, 0, 5 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1, 5 * std::sqrt(2.0 / n));
  EXPECT_NEAR(neighbours / n, 0, 5 / std::sqrt(n));
  EXPECT_NEAR(static_cast<double>(beyond_two) / n, 0.0455, 5 * std::sqrt(0.0455 / n));
}

TEST(RandomModel, NeighbouringSeedsAreNotCorrelated) {
  const int n = 100000;
  double product = 0;
  for (int k = 0; k < n; ++k)
    product +=
        random::normal(1, 0, static_cast<std::uint64_t>(k)) * random::normal(2, 0, static_cast<std::uint64_t>(k));
  EXPECT_NEAR(product / n, 0, 5 / std::sqrt(n));
}

TEST(RandomModel, UniformNumbersFillTheOpenIntervalEvenly) {
  const int n = 100000;
  int bins[10] = {};
  for (int k = 0; k < n; ++k) {
    const double x = random::uniform(9, 0, static_cast<std::uint64_t>(k));
    ASSERT_GT(x, 0);
    ASSERT_LT(x, 1);
    ++bins[static_cast<int>(10 * x)];
  }
  for (const int count : bins) EXPECT_NEAR(count, n / 10, 5 * std::sqrt(n * 0.09));
}

}  // namespace
}  // namespace hysteron
