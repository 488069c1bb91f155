#include "engine/diagram/number_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hysteron {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(NumberText, IsReadToTheLastBitAndSaysHowFar) {
  double value = 0;
  EXPECT_EQ(read_number("-1.5e-3 um/V", value), 7U);
  EXPECT_EQ(value, -1.5e-3);
  EXPECT_EQ(read_number("+7", value), 2U);
  EXPECT_EQ(value, 7);
  for (const char* none : {"", "+", "+-5", "++5", " 5", "um", "-", "e5", "+nan"})
    EXPECT_EQ(read_number(none, value), 0U);
}

TEST(NumberText, WordsThatBeginLikeOneAreNone) {
  double value = 0;
  for (const char* word : {"nand", "nano", "inflate", "infinit", "-info", "inf_2", "nan0"})
    EXPECT_EQ(read_number(word, value), 0U) << word;
  EXPECT_EQ(read_number("-inf V", value), 4U);
  EXPECT_EQ(read_number("infinity", value), 8U);
  EXPECT_EQ(read_number("nan", value), 3U);
  EXPECT_EQ(read_number("inf*u", value), 3U);
}

TEST(NumberText, SubnormalNumbersAreNumbers) {
  // What std::stod throws for: every power of two below the normal ones reads back as itself.
  for (int exponent = -1074; exponent < -1020; ++exponent) {
    const double x = std::ldexp(1.0, exponent);
    EXPECT_EQ(number_of(fmt::format("{}", x)), x);
    EXPECT_EQ(rounded_to_digits(x, 17), x);
  }
}

TEST(NumberText, BeyondTheRangeItIsZeroOrInfinite) {
  for (const char* small : {"1e-400", "0.00001e-399", "1e-99999999999999999999", "2e-324"})
    EXPECT_EQ(number_of(small), 0);
  for (const char* large : {"1e400", "1000000e303", "1e99999999999999999999", "0.001e312"})
    EXPECT_EQ(number_of(large), infinity);
  EXPECT_EQ(number_of("-1e400"), -infinity);
  EXPECT_TRUE(std::signbit(number_of("-1e-400").value()));
  EXPECT_EQ(number_of(std::string(400, '9')), infinity);
  EXPECT_EQ(number_of("0." + std::string(400, '0') + "1"), 0);
}

TEST(NumberText, AWholeTextIsOneNumberOrNone) {
  EXPECT_EQ(number_of("5e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_FALSE(number_of("5 V"));
  EXPECT_FALSE(number_of("0x10"));
}

TEST(NumberText, RoundsToSignificantDigits) {
  EXPECT_EQ(rounded_to_digits(1234.5678, 3), 1230);
  EXPECT_EQ(rounded_to_digits(-0.00012345, 2), -0.00012);
}

TEST(NumberText, AWholeNumberInFrontOrWhatIsSaidOtherwise) {
  EXPECT_EQ(leading_whole_number("12]", 0), 12);
  EXPECT_EQ(leading_whole_number("x", -2), -2);
  EXPECT_EQ(leading_whole_number("99999999999", -2), -2);
}

}  // namespace
}  // namespace hysteron
