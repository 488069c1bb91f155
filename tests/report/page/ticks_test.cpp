// Ticks of axes: round, inside the range, readable.
#include "report/page/ticks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hysteron {
namespace {

std::vector<std::string> labels(const Ticks& ticks) {
  std::vector<std::string> list;
  for (const auto& tick : ticks.list) list.push_back(tick.label);
  return list;
}
using Labels = std::vector<std::string>;

TEST(LinearTicks, StandAtRoundNumbersInsideTheRange) {
  EXPECT_EQ(labels(linear_ticks(0, 10, 5)), (Labels{"0", "2", "4", "6", "8", "10"}));
  EXPECT_EQ(labels(linear_ticks(-0.31, 0.34, 6)), (Labels{"−0.2", "0.0", "0.2"}));
}

TEST(LinearTicks, ZeroIsZeroAndNeverMinusZero) {
  for (const auto& tick : linear_ticks(-3, 3, 6).list)
    if (tick.at == 0) {
      EXPECT_FALSE(std::signbit(tick.at));
      EXPECT_EQ(tick.label, "0");
    }
}

TEST(LinearTicks, ShareOneExponentWhereNumbersAreTiny) {
  const auto ticks = linear_ticks(0, 3e-6, 6);
  EXPECT_EQ(ticks.exponent, -6);
  EXPECT_EQ(labels(ticks), (Labels{"0.0", "0.5", "1.0", "1.5", "2.0", "2.5", "3.0"}));
  EXPECT_EQ(exponent_text(ticks.exponent), "×10⁻⁶");
}

TEST(LinearTicks, NeighboursDifferAlsoOnALargeOffset) {
  // A temperature of 293.15 K moving by 2 mK: labels that all read "293.15" would be useless.
  const auto list = labels(linear_ticks(293.150, 293.152, 5));
  ASSERT_GE(list.size(), 3U);
  for (std::size_t i = 1; i < list.size(); ++i) EXPECT_NE(list[i - 1], list[i]);
}

TEST(LinearTicks, EndWhereNumbersLieTooCloseForMore) {
  for (const double low : {1.0, 1e9, 1e300})
    EXPECT_LE(linear_ticks(low, std::nextafter(low, 2 * low), 6).list.size(), 100U);
  EXPECT_LE(linear_ticks(1 - 1e-15, 1 + 1e-15, 50).list.size(), 100U);
}

TEST(LinearTicks, AreAbsentForARangeThatIsNone) {
  EXPECT_TRUE(linear_ticks(1, 1, 5).list.empty());
  EXPECT_TRUE(linear_ticks(0, std::numeric_limits<double>::infinity(), 5).list.empty());
}

TEST(LogTicks, StandAtDecades) {
  EXPECT_EQ(labels(log_ticks(0.09, 1100, 6)), (Labels{"0.1", "1", "10", "100", "1000"}));
  EXPECT_EQ(labels(log_ticks(1e-7, 1e-4, 5)), (Labels{"10⁻⁷", "10⁻⁶", "10⁻⁵", "10⁻⁴"}));
}

TEST(LogTicks, FillTheSpaceBetweenFewDecades) {
  EXPECT_EQ(labels(log_ticks(1, 100, 8)), (Labels{"1", "2", "5", "10", "20", "50", "100"}));
}

TEST(LogTicks, BelowOneDecadeAreLinear) { EXPECT_EQ(labels(log_ticks(2, 5, 4)), (Labels{"2", "3", "4", "5"})); }

TEST(LogTicks, SkipDecadesWhereThereAreMany) { EXPECT_LE(log_ticks(1e-20, 1e10, 6).list.size(), 7U); }

}  // namespace
}  // namespace hysteron
