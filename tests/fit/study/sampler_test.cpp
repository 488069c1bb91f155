// Draws of studies: even where they shall be, the same whatever is asked for first.
#include "fit/study/sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace hysteron {
namespace {

std::vector<std::vector<double>> draws_of(Sampler sampler, std::uint64_t n) {
  std::vector<std::vector<double>> all(n, std::vector<double>(sampler.parameters()));
  for (std::uint64_t i = 0; i < n; ++i) sampler.draw(i, all[i]);
  return all;
}

const std::vector<SampledRange> two{{2, 6}, {0.01, 10, true}};

/// Share of the range that lies below a value, as each of `two` is spread.
double share(double value, std::size_t parameter) {
  return parameter == 0 ? (value - 2) / 4 : std::log(value / 0.01) / std::log(1000);
}

TEST(Sampler, UniformDrawsFillTheRangeEvenlyAndDoNotDependOnEachOther) {
  constexpr std::uint64_t n = 20000;
  const auto all = draws_of(Sampler(SamplingMethod::uniform, 7, 0, two), n);
  double cross = 0;
  for (std::size_t p = 0; p < 2; ++p) {
    std::vector<double> shares;
    for (const auto& d : all) shares.push_back(share(d[p], p));
    std::sort(shares.begin(), shares.end());
    EXPECT_GT(shares.front(), 0);
    EXPECT_LT(shares.back(), 1);
    double distance = 0;  // Kolmogorov-Smirnov
    for (std::size_t i = 0; i < n; ++i)
      distance = std::max(distance, std::abs(shares[i] - (static_cast<double>(i) + 0.5) / n));
    EXPECT_LT(distance, 1.95 / std::sqrt(n));  // one in a thousand of truly uniform sets lies above
  }
  for (const auto& d : all) cross += 12 * (share(d[0], 0) - 0.5) * (share(d[1], 1) - 0.5) / n;
  EXPECT_LT(std::abs(cross), 4 / std::sqrt(n));  // correlation: four standard errors
}

TEST(Sampler, ADrawDependsOnSeedAndIndexAlone) {
  for (const auto method : {SamplingMethod::uniform, SamplingMethod::latin_hypercube, SamplingMethod::sobol}) {
    const auto forward = draws_of(Sampler(method, 3, 64, two), 64);
    Sampler again(method, 3, 64, two);
    Sampler copy(again);
    std::vector<double> values(2), of_copy(2);
    for (const std::uint64_t i : {63U, 5U, 5U, 0U, 17U}) {
      again.draw(i, values);
      copy.draw(i, of_copy);
      EXPECT_EQ(values, forward[i]);
      EXPECT_EQ(of_copy, forward[i]);
    }
    EXPECT_NE(draws_of(Sampler(method, 4, 64, two), 64), forward);
  }
}

TEST(Sampler, ALatinHypercubeHasOneDrawInEachPartOfEachParameter) {
  for (const std::uint64_t n : {1U, 7U, 64U, 1000U}) {
    Sampler sampler(SamplingMethod::latin_hypercube, 11, n, two);
    EXPECT_EQ(sampler.size(), n);
    const auto all = draws_of(sampler, n);
    for (std::size_t p = 0; p < 2; ++p) {
      std::set<int> parts;
      for (const auto& d : all) parts.insert(static_cast<int>(std::floor(share(d[p], p) * static_cast<double>(n))));
      EXPECT_EQ(parts.size(), n);
      EXPECT_EQ(*parts.begin(), 0);
      EXPECT_EQ(*parts.rbegin(), static_cast<int>(n) - 1);
    }
  }
}

TEST(Sampler, TheOrderOfALatinHypercubeIsAPermutationWithoutAPattern) {
  for (const std::uint64_t n : {2U, 3U, 5U, 16U, 17U, 1000U, 4097U}) {
    std::set<std::uint64_t> seen;
    for (std::uint64_t i = 0; i < n; ++i) seen.insert(shuffled(i, n, 99));
    EXPECT_EQ(seen.size(), n);
    EXPECT_EQ(*seen.rbegin(), n - 1);
  }
  // Neighbours in one order are not neighbours in the other: correlation within four standard errors of none.
  constexpr std::uint64_t n = 10007;
  double with_index = 0, with_next = 0;
  for (std::uint64_t i = 0; i < n; ++i) {
    const auto centred = [](std::uint64_t v) { return static_cast<double>(v) / n - 0.5; };
    with_index += 12 * centred(i) * centred(shuffled(i, n, 5)) / n;
    with_next += 12 * centred(shuffled(i, n, 5)) * centred(shuffled((i + 1) % n, n, 5)) / n;
  }
  EXPECT_LT(std::abs(with_index), 4 / std::sqrt(n));
  EXPECT_LT(std::abs(with_next), 4 / std::sqrt(n));
}

TEST(Sampler, SobolPointsAreThoseOfTheLiterature) {
  // First points in three dimensions with the direction numbers of Joe and Kuo (SIAM J. Sci. Comput. 30, 2008), in Gray
  // code order; the same as scipy.stats.qmc.Sobol(3, scramble=False) gives.
  const std::vector<std::vector<double>> first{{0, 0, 0},
                                               {0.5, 0.5, 0.5},
                                               {0.75, 0.25, 0.25},
                                               {0.25, 0.75, 0.75},
                                               {0.375, 0.375, 0.625},
                                               {0.875, 0.875, 0.125},
                                               {0.625, 0.125, 0.875},
                                               {0.125, 0.625, 0.375}};
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(sobol_point(i, 3), first[i]) << i;
}

TEST(Sampler, SobolDrawsAreBalancedWithTheRandomShiftToo) {
  // 2^m points of a digital net: every dyadic part of a parameter, and every dyadic box of the first two, holds the
  // same number of points.
  const auto all = draws_of(Sampler(SamplingMethod::sobol, 21, 0, two), 256);
  std::vector<int> part(256, 0), box(256, 0);
  for (const auto& d : all) {
    ++part[static_cast<std::size_t>(share(d[0], 0) * 256)];
    ++box[static_cast<std::size_t>(share(d[0], 0) * 16) * 16 + static_cast<std::size_t>(share(d[1], 1) * 16)];
  }
  EXPECT_EQ(std::count(part.begin(), part.end(), 1), 256);
  EXPECT_EQ(std::count(box.begin(), box.end(), 1), 256);
}

TEST(Sampler, AGridHasEveryCombinationWithBothEnds) {
  std::vector<SampledRange> ranges{{1, 3, false, 3}, {1, 100, true, 3}, {}};
  ranges[2].values = {5, 7};
  Sampler sampler(SamplingMethod::grid, 1, 0, ranges);
  ASSERT_EQ(sampler.size(), 18U);
  const auto all = draws_of(sampler, 18);
  EXPECT_EQ(all[0], (std::vector<double>{1, 1, 5}));
  EXPECT_EQ(all[1], (std::vector<double>{1, 1, 7}));
  EXPECT_DOUBLE_EQ(all[2][1], 10);
  EXPECT_EQ(all[17], (std::vector<double>{3, 100, 7}));
  EXPECT_EQ((std::set<std::vector<double>>(all.begin(), all.end())).size(), 18U);
}

TEST(Sampler, AListIsTakenRowByRow) {
  std::vector<SampledRange> ranges(2);
  ranges[0].values = {1, 2, 3};
  ranges[1].values = {4, 5, 6};
  Sampler sampler(SamplingMethod::list, 1, 0, ranges);
  ASSERT_EQ(sampler.size(), 3U);
  EXPECT_EQ(draws_of(sampler, 3)[1], (std::vector<double>{2, 5}));
}

}  // namespace
}  // namespace hysteron
