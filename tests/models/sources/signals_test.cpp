#include "models/sources/signals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/block/dual.h"
#include "tests/models/golden.h"

namespace hysteron {
namespace {

using namespace signals;

double triangle_at(double t, double f, double phase) { return triangle(t, f, phase, triangle_piece(f, phase, t)); }

TEST(SignalsModel, GoldenSineAndTriangleOfTheThesisAreReproduced) {
  HYSTERON_NEEDS_GOLDEN("signals");
  const auto trace = golden::read("signals");
  const auto& t = trace.at("t [s]");
  for (std::size_t k = 0; k < t.size(); ++k) {  // Eqs. 2.40, 2.41 with A = 3, f = 5 Hz; ten digits of numbers up to 6
    ASSERT_NEAR(3 + 3 * sine(t[k], 5.0, -pi / 2), trace.at("sine [V]")[k], 1e-9);
    ASSERT_NEAR(3 + 3 * triangle_at(t[k], 5.0, -pi / 2), trace.at("triangle [V]")[k], 1e-9);
  }
}

TEST(SignalsModel, GoldenStaircaseOfTheThesisIsASineTimesAStaircase) {
  HYSTERON_NEEDS_GOLDEN("signal_staircase");
  const auto trace = golden::read("signal_staircase");
  const auto& t = trace.at("t [s]");
  for (std::size_t k = 0; k < t.size(); ++k) {  // Eq. 5.19: floor(t)/2 (1 + sin(2 pi 5 t - pi/2)), nine levels 0 ... 8
    const double level = staircase_piece(1.0, 9, t[k]);
    ASSERT_NEAR(level / 2 * (1 + sine(t[k], 5.0, -pi / 2)), trace.at("u [V]")[k], 1e-9);
  }
}

TEST(SignalsModel, TriangleHasTheZerosAndExtremesOfTheSine) {
  for (const double phase : {-1.2, 0.0, 2.5})
    for (double t = -3; t < 3; t += 0.0371)
      ASSERT_NEAR(triangle_at(t, 0.7, phase), 2 / pi * std::asin(sine(t, 0.7, phase)),
                  1e-7);  // asin near 1: sqrt of 1e-16
}

TEST(SignalsModel, TriangleTurnsAtEveryCornerAndNowhereElse) {
  // Frequencies whose half periods are no binary fractions: the piece at a corner must be the one behind it, always.
  for (const double f : {0.3, 7.1, 49.99}) {
    const double phase = 0.321;
    double t = 0;
    for (int k = 0; k < 20000; ++k) {
      const double piece = triangle_piece(f, phase, t);
      const double breakpoint = triangle_breakpoint(f, phase, piece + 1);
      ASSERT_GT(breakpoint, t);
      ASSERT_EQ(triangle_piece(f, phase, breakpoint), piece + 1);
      ASSERT_EQ(triangle_piece(f, phase, std::nextafter(breakpoint, 0)), piece);
      ASSERT_NEAR(std::fabs(triangle(breakpoint, f, phase, piece)), 1,
                  1e-9);  // 1e-16 of the phase of 20000 half periods
      t = breakpoint;
    }
  }
}

TEST(SignalsModel, StaircaseHoldsItsFirstAndLastLevel) {
  EXPECT_EQ(staircase_piece(0.1, 5, -3), 0);
  EXPECT_EQ(staircase_piece(0.1, 5, 0.05), 0);
  EXPECT_EQ(staircase_piece(0.1, 5, 99), 4);
  EXPECT_EQ(staircase_next_breakpoint(0.1, 5, -3), 0.1);
  EXPECT_EQ(staircase_next_breakpoint(0.1, 5, 0.4), never);
  EXPECT_EQ(staircase_next_breakpoint(0.1, 1, 0), never);
}

TEST(SignalsModel, StaircaseCornersAndLevelsAgreeForDurationsThatAreNoBinaryFraction) {
  double t = 0;
  for (double k = 0; k < 999; ++k) {
    ASSERT_EQ(staircase_piece(0.1, 1000, t), k);
    t = staircase_next_breakpoint(0.1, 1000, t);
  }
  EXPECT_EQ(staircase_next_breakpoint(0.1, 1000, t), never);
}

TEST(SignalsModel, ChirpRunsThroughTheGivenFrequencies) {
  for (const Sweep sweep : {Sweep::linear, Sweep::logarithmic}) {
    const auto frequency = [&](double t, int piece) {
      return chirp_cycles(Dual{t, 1}, Dual{2.0}, Dual{50.0}, Dual{4.0}, sweep, piece).rate;
    };
    EXPECT_NEAR(frequency(-1, -1), 2, 1e-12);
    EXPECT_NEAR(frequency(0, 0), 2, 1e-12);
    EXPECT_NEAR(frequency(2, 0), sweep == Sweep::linear ? 26 : 10, 1e-12);  // mean: arithmetic or geometric
    EXPECT_NEAR(frequency(4, 0), 50, 1e-12);
    EXPECT_NEAR(frequency(7, 1), 50, 1e-12);
    // continuous where the pieces meet
    EXPECT_NEAR(chirp_cycles(4.0, 2.0, 50.0, 4.0, sweep, 0), chirp_cycles(4.0, 2.0, 50.0, 4.0, sweep, 1), 1e-12);
    EXPECT_EQ(chirp_cycles(0.0, 2.0, 50.0, 4.0, sweep, 0), 0);
  }
}

TEST(SignalsModel, LogarithmicChirpBetweenEqualFrequenciesIsASine) {
  EXPECT_NEAR(chirp_cycles(1.7, 3.0, 3.0, 4.0, Sweep::logarithmic, 0), 3 * 1.7, 1e-14);
  // nearly equal: the series and the quotient meet at |rate| = 1e-3
  EXPECT_NEAR(growth(1e-3, 1.0), growth(std::nextafter(1e-3, 1), 1.0), 1e-12);
}

TEST(SignalsModel, MultisineHasRootMeanSquareOneOverItsPeriod) {
  const double n = multisine_count(1, 20, 1);
  EXPECT_EQ(n, 20);
  double squares = 0;
  for (int k = 0; k < 1000; ++k) {  // one period of 1 s; 1000 samples resolve 20 Hz, so the sum is exact
    const double y = multisine(k / 1000.0, 1.0, 1.0, n, 5);
    squares += y * y;
  }
  EXPECT_NEAR(squares / 1000, 1, 1e-12);
  EXPECT_NEAR(multisine(0.123, 1.0, 1.0, n, 5), multisine(1.123, 1.0, 1.0, n, 5), 1e-12);
  EXPECT_NE(multisine(0.123, 1.0, 1.0, n, 5), multisine(0.123, 1.0, 1.0, n, 6));
}

TEST(SignalsModel, MultisineCountsItsHighestFrequencyInSpiteOfRounding) {
  EXPECT_EQ(multisine_count(0.1, 0.3, 0.1), 3);  // 0.3/0.1 rounds below 3
  EXPECT_EQ(multisine_count(1, 1, 0.5), 1);
  EXPECT_EQ(multisine_count(1, 2.4, 0.5), 3);
}

}  // namespace
}  // namespace hysteron
