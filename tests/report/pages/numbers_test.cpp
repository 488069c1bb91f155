// How numbers look to people: no power of ten where a prefix or a plain number does, as many digits as an interval
// allows.
#include "report/pages/numbers.h"

#include <gtest/gtest.h>

namespace hysteron {
namespace {

TEST(NumberText, WritesLargeNumbersOutUpToSixDigits) {
  EXPECT_EQ(number_text(12345, 4), "12345");
  EXPECT_EQ(number_text(6424, 3), "6424");
  EXPECT_EQ(number_text(1.5e7, 4), "1.5e+07");
  EXPECT_EQ(number_text(12.345, 4), "12.35");  // as before
}

TEST(QuantityText, GivesSmallNumbersOfPlainUnitsAPrefix) {
  EXPECT_EQ(quantity_text(5.04e-6, parse_unit("m")), "5.04 um");
  EXPECT_EQ(quantity_text(-1.5e-5, parse_unit("m/s")), "-0.015 mm/s");
  EXPECT_EQ(quantity_text(2e-10, parse_unit("m")), "0.2 nm");
  EXPECT_EQ(quantity_text(2e-11, parse_unit("um")), "0.02 nm");
  EXPECT_EQ(difference_text(2.34e-10, parse_unit("um")), "0.234 nm");
}

TEST(QuantityText, KeepsTheUnitOfTheDataWhereItIsReadable) {
  EXPECT_EQ(quantity_text(8.59e-4, parse_unit("mm")), "0.859 mm");
  EXPECT_EQ(quantity_text(2e-3, parse_unit("m")), "0.002 m");  // a level or a parameter, as its file has it
  EXPECT_EQ(difference_text(0.0612e-6, parse_unit("um")), "0.0612 um");
  EXPECT_EQ(quantity_text(0, parse_unit("m")), "0 m");
  EXPECT_EQ(quantity_text(1e-5, parse_unit("1")), "1e-05");  // no unit, no prefix
}

TEST(ReadableUnitOfRange, IsThatOfTheSmallEndUnlessTheLargeOneHasFiveDigitsThere) {
  const auto text = [](double small, double large) {
    return readable_unit_of_range(small, large, parse_unit("um")).text;
  };
  EXPECT_EQ(text(2.34e-10, 61.2e-9), "nm");
  EXPECT_EQ(text(2e-8, 3e-6), "um");    // 0.02 um is read as it is
  EXPECT_EQ(text(2e-9, 9.9e-6), "nm");  // 2 and 9900
  EXPECT_EQ(text(2e-9, 12e-6), "um");   // 12000
  EXPECT_EQ(text(1e-13, 2e-8), "um");   // 0.02 in place of 20000 pm
  EXPECT_DOUBLE_EQ(readable_unit_of_range(2.34e-10, 61.2e-9, parse_unit("um")).times, 1000);
}

TEST(DigitsWithin, ShowTwoOfTheHalfWidth) {
  EXPECT_EQ(digits_within(0.47438, 0.47299, 0.47578), 4);             // 0.4744, within 0.0014
  EXPECT_EQ(digits_within(0.011102, 0.011092, 0.011113), 5);          // 0.011102, within 0.000011
  EXPECT_EQ(digits_within(1234, 1000, 1500), 3);                      // 1230, within 250
  EXPECT_EQ(digits_within(10, -1000, 1000), 2);                       // and never fewer
  EXPECT_EQ(number_text(0.014, digits_within(0.014, -24, 24)), "0");  // nothing, within 24
  EXPECT_EQ(digits_within(3, 3, 3), 5);                               // an interval without width says nothing
}

}  // namespace
}  // namespace hysteron
