// Prefixes of units: what is read is the same size, and never has zeros to be counted.
#include "engine/diagram/readable_unit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/diagram/units.h"

namespace hysteron {
namespace {

TEST(ReadableUnit, ASmallSizeGetsTheNextPrefixThatLeavesAHundredth) {
  const auto text = [](double number, const char* unit) { return readable_unit(number, unit).text; };
  EXPECT_EQ(text(1.7e-5, "um"), "nm");
  EXPECT_EQ(text(2.34e-4, "um"), "nm");
  EXPECT_EQ(text(1.29e-3, "um"), "nm");
  EXPECT_EQ(text(0.0612, "um"), "um");
  EXPECT_EQ(text(-5.04e-6, "m"), "um");
  EXPECT_EQ(text(3e-4, "N m"), "mN m");
  EXPECT_EQ(text(3e-4, "um/V"), "nm/V");
  EXPECT_EQ(text(2e-3, "rad/s"), "mrad/s");
  EXPECT_EQ(text(2e-3, "kV"), "V");
  EXPECT_EQ(text(9.9e-6, "m"), "um");    // 0.0099 mm
  EXPECT_EQ(text(2.8e-16, "um"), "um");  // no prefix is so small: rounding, no size
}

TEST(ReadableUnit, WhatHasNoPrefixStays) {
  for (const char* unit : {"", "1", "deg", "degC", "%", "min", "h", "1/s", "mm^2", "kg", "K", "V^2/m", "in", "dB"})
    EXPECT_EQ(readable_unit(1e-6, unit).text, unit);
  EXPECT_EQ(readable_unit(0, "um").text, "um");
  EXPECT_EQ(readable_unit(-0.01, "um").text, "um");
  EXPECT_EQ(readable_unit(std::nan(""), "um").text, "um");
  EXPECT_EQ(readable_unit(5e-3, "um", 1e-3).text, "um");
}

TEST(ReadableUnit, IsTheSameSize) {
  for (const char* name : {"m", "mm", "um", "kV", "mrad", "N m", "um/V", "mm/s^2", "Pa", "ms", "mHz", "ohm"})
    for (double number = 9e-3; number > 1e-10; number /= 7) {
      const ReadableUnit r = readable_unit(number, name);
      const double before = number * parse_unit(name).scale, after = r.times * number * parse_unit(r.text).scale;
      EXPECT_NEAR(after, before, 1e-15 * before * 4) << name << " " << number << " " << r.text;  // three products
      EXPECT_GE(std::abs(r.times * number), 0.01) << name;
      EXPECT_LT(std::abs(r.times * number), 10) << name;
    }
}

}  // namespace
}  // namespace hysteron
