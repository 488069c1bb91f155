// Sizes, levels and falls of errors as sentences tell them.
#include "fit/signals/unit_words.h"

#include <gtest/gtest.h>

namespace hysteron {
namespace {

TEST(UnitWords, SmallSizesGetAPrefixAndLevelsStayInTheirUnit) {
  const Unit um = parse_unit("um");
  EXPECT_EQ(size_text(0.0612e-6, um), "0.0612 um");
  EXPECT_EQ(size_text(1.7e-11, um), "0.017 nm");
  EXPECT_EQ(size_text(2.35e-3, um), "2350 um");
  EXPECT_EQ(size_text(0, um), "0 um");
  EXPECT_EQ(size_text(0.5, parse_unit("degC")), "0.5 degC");
  EXPECT_EQ(level_text(1.7e-11, um), "1.7e-05 um");
  EXPECT_EQ(range_text(0, 5, parse_unit("V")), "0 .. 5 V");
}

TEST(UnitWords, BothEndsOfAFallAreInOneUnitUnlessTheyLieFarApart) {
  const Unit um = parse_unit("um");
  EXPECT_EQ(fall_text(0.0612e-6, 0.234e-9, um), "61.2 nm -> 0.234 nm");
  EXPECT_EQ(fall_text(59e-6, 2.03e-6, um), "59 um -> 2.03 um");
  EXPECT_EQ(fall_text(12e-6, 0.234e-9, um), "12 um -> 0.234 nm");  // 12000 nm
  EXPECT_EQ(fall_text(1e-6, 0, um), "1 um -> 0 um");
}

TEST(UnitWords, SmallFractionsAreTheMillionth) {
  EXPECT_EQ(fraction_text(0.012), "1.2 %");
  EXPECT_EQ(fraction_text(1e-4), "0.01 %");
  EXPECT_EQ(fraction_text(3.86e-7), "0.386 ppm");
  EXPECT_EQ(fraction_text(-3.55e-6), "-3.55 ppm");
  EXPECT_EQ(fraction_text(0), "0 %");
}

}  // namespace
}  // namespace hysteron
