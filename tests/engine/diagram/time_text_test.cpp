// Times as people read them: three digits, in the unit in which these are no power of ten.
#include "engine/diagram/time_text.h"

#include <gtest/gtest.h>

namespace hysteron {
namespace {

TEST(TimeText, WritesThreeDigitsInTheUnitThatSuits) {
  EXPECT_EQ(time_text(0), "0 s");
  EXPECT_EQ(time_text(2e-7), "0.2 us");
  EXPECT_EQ(time_text(2.5e-3), "2.5 ms");
  EXPECT_EQ(time_text(-16), "-16 s");
  EXPECT_EQ(time_text(1800), "30 min");
  EXPECT_EQ(time_text(9000), "2.5 h");
}

TEST(TimeText, WhatRoundsToAThousandIsOneOfTheNextUnit) {
  EXPECT_EQ(time_text(0.9999999e-3), "1 ms");  // a step of a clock that was written with few digits
  EXPECT_EQ(time_text(0.99951), "1 s");
  EXPECT_EQ(time_text(0.9994), "999 ms");
  EXPECT_EQ(time_text(0.9994e-3), "999 us");
  EXPECT_EQ(time_text(999.7), "16.7 min");
}

}  // namespace
}  // namespace hysteron
