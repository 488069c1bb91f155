// The bounds of a search, as the pages of the effects tell them.
#include "discover/hypotheses/bounds.h"

#include <gtest/gtest.h>

#include "discover/effects/all.h"

namespace hysteron {
namespace {

std::string told(const std::string& effect, const std::string& parameter) {
  static const Effects all = all_effects();
  return bounds_text(all.get(effect), parameter);
}

TEST(BoundsOfASearch, AreNumbersWhereTheyAreAlwaysTheSame) {
  EXPECT_EQ(told("creep", "per_decade"), "0 .. 0.4");
  EXPECT_EQ(told("rate_dependence", "ahead"), "-0.5 .. 1.5");
  EXPECT_EQ(told("sqrt_outflow", "outlet"), "0 or more");
}

TEST(BoundsOfASearch, ElseSayWhatSetsThem) {
  EXPECT_EQ(told("dead_time", "delay"), "0 .. (set by the length of the recordings)");
  EXPECT_EQ(told("stiffening", "stiffening"), "(set by the range of the signal)");
  EXPECT_EQ(told("ageing", "per_decade"), "(set by what it reads besides) .. 0.3");
  EXPECT_EQ(told("ageing", "first"), "(set by what it reads besides)") << "cycles or hours";
  EXPECT_EQ(told("saturation", "lower"), "(set by the range of the signal)");
}

TEST(BoundsOfASearch, AreNotToldWhereThereAreNone) {
  EXPECT_EQ(told("calibration", "gain"), "");
  EXPECT_EQ(told("creep", "times"), "") << "no fit changes them";
}

}  // namespace
}  // namespace hysteron
