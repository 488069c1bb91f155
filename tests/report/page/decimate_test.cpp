// Thinning out long curves: no peak is lost, no gap is closed, the budget holds.
#include "report/page/decimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace hysteron {
namespace {

struct Wave {
  std::vector<double> x, y;
};

Wave wave(std::size_t n) {
  Wave w;
  for (std::size_t i = 0; i < n; ++i) {
    w.x.push_back(1e-3 * static_cast<double>(i));
    w.y.push_back(std::sin(0.01 * static_cast<double>(i)) + 0.1 * std::sin(17.0 * static_cast<double>(i)));
  }
  return w;
}

bool holds(const std::vector<std::size_t>& kept, std::size_t index) {
  return std::binary_search(kept.begin(), kept.end(), index);
}

TEST(Decimate, KeepsAShortCurveWhole) {
  const auto w = wave(100);
  EXPECT_EQ(decimate(w.x, w.y, 100).size(), 100U);
}

TEST(Decimate, StaysInItsBudgetAndUsesMostOfIt) {
  const auto w = wave(100000);
  const auto kept = decimate(w.x, w.y, 4000);
  EXPECT_LE(kept.size(), 4000U);
  EXPECT_GE(kept.size(), 3000U);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  EXPECT_TRUE(std::adjacent_find(kept.begin(), kept.end()) == kept.end());
}

TEST(Decimate, KeepsEverySinglePeakAndBothEnds) {
  auto w = wave(100000);
  const std::vector<std::size_t> peaks{1, 777, 50001, 99998};
  for (const auto i : peaks) w.y[i] = i % 2 == 0 ? -9 : 9;
  const auto kept = decimate(w.x, w.y, 2000);
  for (const auto i : peaks) EXPECT_TRUE(holds(kept, i)) << i;
  EXPECT_EQ(kept.front(), 0U);
  EXPECT_EQ(kept.back(), 99999U);
}

TEST(Decimate, DropsOnlyWhatLiesBetweenKeptNeighbours) {
  // 20 000 points at four per bucket are at least 4900 buckets, of at most 21 rows: 40 rows around hold the point's
  // own.
  const auto w = wave(100000);
  const auto kept = decimate(w.x, w.y, 20000);
  for (std::size_t i = 0; i < w.y.size(); ++i) {
    auto near = std::lower_bound(kept.begin(), kept.end(), i < 40 ? 0 : i - 40);
    bool below = false, above = false;
    for (; near != kept.end() && *near <= i + 40; ++near) {
      below = below || w.y[*near] <= w.y[i];
      above = above || w.y[*near] >= w.y[i];
    }
    ASSERT_TRUE(below && above) << i;
  }
}

TEST(Decimate, KeepsTheExtremesOfALoopInBothDirections) {
  std::vector<double> x, y;
  for (int i = 0; i < 50000; ++i) {
    x.push_back(std::cos(0.37 * i));
    y.push_back(std::sin(0.41 * i));
  }
  x[12345] = 7;
  x[23456] = -7;
  y[34567] = 7;
  const auto kept = decimate(x, y, 3000);
  EXPECT_LE(kept.size(), 3000U);
  for (const std::size_t i : {12345U, 23456U, 34567U}) EXPECT_TRUE(holds(kept, i)) << i;
}

TEST(Decimate, LeavesAGapAGap) {
  auto w = wave(100000);
  w.y[40000] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(holds(decimate(w.x, w.y, 2000), 40000));
}

TEST(Decimate, EndsAlsoWhereAllPointsShareOneX) {
  const std::vector<double> x(10000, 3.0);
  std::vector<double> y(10000);
  std::iota(y.begin(), y.end(), 0.0);
  const auto kept = decimate(x, y, 100);
  EXPECT_TRUE(holds(kept, 0) && holds(kept, 9999));
  EXPECT_LE(kept.size(), 100U);
}

TEST(ShareBudget, LetsShortCurvesKeepAllAndDividesTheRest) {
  EXPECT_EQ(share_budget({10, 100000, 50000}, 20010), (std::vector<std::size_t>{10, 10000, 10000}));
  EXPECT_EQ(share_budget({10, 20}, 100), (std::vector<std::size_t>{10, 20}));
  EXPECT_TRUE(share_budget({}, 100).empty());
}

}  // namespace
}  // namespace hysteron
