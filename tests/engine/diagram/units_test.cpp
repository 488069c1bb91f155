#include "engine/diagram/units.h"

#include <gtest/gtest.h>

#include <numbers>

#include "engine/diagram/error.h"
#include "engine/diagram/unit_table.h"

namespace hysteron {
namespace {

TEST(Units, ScaleNumbersToSi) {
  EXPECT_DOUBLE_EQ(parse_unit("um").to_si(3), 3e-6);
  EXPECT_DOUBLE_EQ(parse_unit("V/um").to_si(2), 2e6);
  EXPECT_DOUBLE_EQ(parse_unit("kHz").to_si(2), 2000);
  EXPECT_DOUBLE_EQ(parse_unit("deg").to_si(180), std::numbers::pi);
  EXPECT_DOUBLE_EQ(parse_unit("V/(um s)").to_si(7009), 7.009e9);
  EXPECT_DOUBLE_EQ(parse_unit("%").to_si(50), 0.5);
}

TEST(Units, TemperaturesHaveAnOffsetAndTheirDifferencesHaveNone) {
  const Unit celsius = parse_unit("degC");
  EXPECT_DOUBLE_EQ(celsius.to_si(22), 295.15);
  EXPECT_DOUBLE_EQ(celsius.difference_to_si(0.01), 0.01);  // a noise of 0.01 degC is not 273.16 K
  EXPECT_DOUBLE_EQ(celsius.from_si(295.15), 22);
}

TEST(Units, FiveHertzAreNotFiveRadiansPerSecond) {
  const auto hertz = parse_unit("Hz").dimension;
  const auto radians = parse_unit("rad/s").dimension;
  EXPECT_NE(hertz, radians);
  EXPECT_DOUBLE_EQ(dimension_factor(hertz, radians), 2 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(dimension_factor(radians, hertz), 1 / (2 * std::numbers::pi));
  EXPECT_EQ(dimension_factor(hertz, parse_unit("1/s").dimension), 0);
}

TEST(Units, TheSiTextOfADimensionReadsBackAsThatDimension) {
  for (const char* text : {"um", "V/um", "Hz", "rad/s", "degC", "ohm", "m/V", "uC", "V/(um s)", "N s/m", "K/W"}) {
    const Dimension d = parse_unit(text).dimension;
    const Unit back = parse_unit(si_unit(d).text);
    EXPECT_EQ(back.dimension, d) << text << " -> " << si_unit(d).text;
    EXPECT_DOUBLE_EQ(back.scale, 1) << text;
  }
}

TEST(Units, ANonsenseUnitNamesItselfAndACure) {
  try {
    parse_unit("volts per furlong-ish", "/blocks/a/gain");
    FAIL() << "accepted";
  } catch (const Error& e) {
    ASSERT_EQ(e.problems.size(), 1U);
    EXPECT_EQ(e.problems[0].code, "bad_unit");
    EXPECT_EQ(e.problems[0].path, "/blocks/a/gain");
    EXPECT_FALSE(e.problems[0].cure.empty());
  }
}

TEST(Units, AnOriginOfItsOwnIsRefusedSinceAChangeWouldLoseIt) {
  for (const char* text : {"um @ 5", "um since 2000", "um from 5", "um after 5", "V ref 3", "s since 2000-01-01",
                           "K @ 273.15", "um Since 2000"}) {
    try {
      parse_unit(text, "/blocks/a/amplitude");
      ADD_FAILURE() << text << " was taken";
    } catch (const Error& e) {
      EXPECT_EQ(e.problems[0].code, "bad_unit") << text;
      EXPECT_EQ(e.problems[0].path, "/blocks/a/amplitude") << text;
    }
  }
}

// Usual units are known without reading udunits2's table; they must mean what they mean there, to the last bit.
TEST(Units, KnownWithoutTheTableMeanWhatTheTableSays) {
  std::vector<std::string> texts{
      "1/s",  "V/um", "um/V",   "V/(um s)", "m.kg/s^2", "kg m2 s-3 A-1", "um^2/Hz", "1/(V um)", "deg/s", "rad/s",
      "N/um", "mm2",  "V s/um", "10 um",    "degC/W",   "J/(kg K)",      "W/m^2/K", "1",        "%/V",   "h-1"};
  const auto symbols = common_unit_symbols();
  auto prefixes = common_unit_prefixes();
  prefixes.emplace_back("");
  for (const auto& symbol : symbols)
    for (const auto& prefix : prefixes)
      for (const auto& further : prefixes) texts.push_back(further + prefix + symbol);
  for (const auto& a : symbols)
    for (const auto& b : symbols) texts.push_back(a + b), texts.push_back(a + "/" + b);
  int known = 0;
  for (const auto& text : texts) {
    const Unit expected = parse_unit_in_full_table(text);
    if (expected.scale == 0) {
      EXPECT_THROW(parse_unit(text), Error) << text;
      continue;
    }
    ++known;
    const Unit unit = parse_unit(text);
    EXPECT_EQ(unit.scale, expected.scale) << text;
    EXPECT_EQ(unit.offset, expected.offset) << text;
    EXPECT_EQ(unit.dimension, expected.dimension) << text;
  }
  EXPECT_GT(known, 1000);
}

TEST(Units, OthersAreReadFromTheTable) {
  EXPECT_DOUBLE_EQ(parse_unit("inch").to_si(1), 0.0254);
  EXPECT_DOUBLE_EQ(parse_unit("day").to_si(1), 86400);
  EXPECT_DOUBLE_EQ(parse_unit("micrometer").to_si(1), 1e-6);
}

TEST(Units, OfValuesThatNobodyGaveOneAreCalledAsEngineersDo) {
  for (const char* text : {"Hz", "N", "V", "N m", "W", "Pa", "ohm", "F", "H", "T", "N/m", "N m/rad", "N m s/rad", "V/s",
                           "m/V", "1/V^2", "Pa/s", "1/N^3"})
    EXPECT_EQ(si_unit(parse_unit(text).dimension).text, text);
  EXPECT_EQ(si_unit(parse_unit("mJ").dimension).text, "N m") << "a torque is a signal";
  EXPECT_EQ(si_unit(parse_unit("um/s^2").dimension).text, "m/s^2") << "what has no name is made of base units";
  for (const char* text : {"N m", "ohm", "N/A", "um/s^2", "kg/s"})
    EXPECT_EQ(si_unit(parse_unit(text).dimension).scale, 1) << text;
}

TEST(Units, AQuantityIsSplitIntoNumberAndUnit) {
  double number = 0;
  std::string unit;
  ASSERT_TRUE(split_quantity("-1.5e-3 um/V", number, unit));
  EXPECT_EQ(number, -1.5e-3);
  EXPECT_EQ(unit, "um/V");
  EXPECT_TRUE(split_quantity("7", number, unit));
  EXPECT_EQ(unit, "");
  EXPECT_FALSE(split_quantity("jiles_atherton", number, unit));
}

}  // namespace
}  // namespace hysteron
