#include "models/sources/pulses.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hysteron {
namespace {

using namespace signals;

TEST(PulsesModel, CornersAreHitByThePieceBehindThemWhateverTheRounding) {
  // Times that are no binary fractions, thousands of periods on.
  const PulseTimes pulse{.period = 0.3, .duty = 0.37, .time = 0.1};
  double t = -5;
  for (double j = 0; j < 20000; ++j) {
    const double corner = pulse.next_breakpoint(t);
    ASSERT_GT(corner, t);
    ASSERT_EQ(pulse.piece(corner), j);
    ASSERT_EQ(pulse.piece(std::nextafter(corner, -1)), j - 1);
    ASSERT_NEAR(corner, 0.1 + 0.3 * (std::floor(j / 2) + (std::fmod(j, 2) == 1 ? 0.37 : 0)), 1e-12 * (1 + j));
    t = corner;
  }
}

TEST(PulsesModel, AGivenNumberOfPulsesEndsLow) {
  const PulseTimes pulse{.period = 2, .duty = 0.25, .time = 1, .pulses = 2};
  for (const auto& [t, high] : std::initializer_list<std::pair<double, bool>>{
           {0.9, false}, {1, true}, {1.49, true}, {1.5, false}, {3, true}, {3.5, false}, {5, false}, {99, false}})
    EXPECT_EQ(pulse.is_high(pulse.piece(t)), high) << t;
  EXPECT_EQ(pulse.next_breakpoint(3.2), 3.5);
  EXPECT_EQ(pulse.next_breakpoint(3.5), never);
}

double trapezoid_at(const TrapezoidTimes& times, double t) {
  return trapezoid(t, times.rise, times.top, times.fall, times.period, times.time, times.piece(t));
}

TEST(PulsesModel, ATrapezoidIsContinuousAndHasItsTimes) {
  for (const double period : {0.7, 0.9, never}) {  // without and with a rest, and once
    const TrapezoidTimes times{.rise = 0.1, .top = 0.2, .fall = 0.4, .period = period, .time = 0.3};
    const auto expected = [&](double t) {
      double s = t - 0.3;
      if (s >= 0 && period < never) s = std::fmod(s, period);
      return s < 0 || s > 0.7 ? 0 : s < 0.1 ? s / 0.1 : s < 0.3 ? 1 : (0.7 - s) / 0.4;
    };
    for (double t = -1; t < 20; t += 0.0137) ASSERT_NEAR(trapezoid_at(times, t), expected(t), 1e-13 * 200) << t;
    double t = -1;
    for (int j = 0; j < 4000; ++j) {
      const double corner = times.next_breakpoint(t);
      if (corner == never) {
        EXPECT_EQ(j, 4);
        EXPECT_EQ(period, never);
        break;
      }
      ASSERT_GT(corner, t);
      const double middle = t + (corner - t) / 2;
      // Two corners may be one but for rounding.
      const double piece = times.piece(corner), before = middle < corner ? times.piece(middle) : piece - 1;
      ASSERT_GT(piece, before);
      const auto at = [&](double on) { return trapezoid(corner, 0.1, 0.2, 0.4, period, 0.3, on); };
      ASSERT_NEAR(at(piece), at(before), 1e-16 * 1e3 / 0.1 * 10);  // rounding of times up to 1000 s over the rise
      t = corner;
    }
  }
}

TEST(PulsesModel, ARampBeginsAndEnds) {
  const RampTimes ramp{.time = 1, .duration = 2};
  EXPECT_EQ(ramp.piece(0.5), -1);
  EXPECT_EQ(ramp.piece(1), 0);
  EXPECT_EQ(ramp.piece(3), 1);
  EXPECT_EQ(ramp.next_breakpoint(0), 1);
  EXPECT_EQ(ramp.next_breakpoint(1), 3);
  EXPECT_EQ(ramp.next_breakpoint(3), never);
  EXPECT_EQ((RampTimes{.time = 1}.next_breakpoint(1)), never);
}

}  // namespace
}  // namespace hysteron
