// What a known line may do beside being steady: that is left out, and nothing else.
#include "fit/signals/wander.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>

namespace hysteron {
namespace {

using std::numbers::pi;

constexpr double hertz = 49.97, step = 0.002;
constexpr std::size_t n = 5000;  // ten seconds

std::vector<double> times() {
  std::vector<double> t;
  for (std::size_t i = 0; i < n; ++i) t.push_back(3 + step * static_cast<double>(i));
  return t;
}

using Part = LineSpan::Part;

double squares_of(const std::vector<double>& rows) {
  double sum = 0;
  for (const double x : rows) sum += x * x;
  return sum;
}

/// Share of the squares of a signal that is left.
double left_of(const std::function<double(double)>& signal, int harmonics = 1, Part part = Part::wandering) {
  const auto t = times();
  const LineSpan span(t, {hertz, harmonics});
  std::vector<double> rows;
  for (const double x : t) rows.push_back(signal(x));
  const double before = squares_of(rows);
  span.take_out(rows, part);
  return squares_of(rows) / before;
}

double line(double t, double phase) { return std::sin(2 * pi * hertz * t + phase); }

TEST(Wander, ASteadyLineIsAModelsOwn) {
  const auto steady = [](double t) { return line(t, 0.7); };
  EXPECT_NEAR(left_of(steady), 1, 1e-9);
  EXPECT_LT(left_of(steady, 1, Part::all), 1e-12);
}

TEST(Wander, AmplitudeAndPhaseThatMoveSlowlyAreLeftOut) {
  // To first order a quarter turn ahead, times the angle: straight lines over 2 s miss angle'' 2^2/8 of it at most.
  const auto turned = [](double t) { return 0.1 * std::sin(0.3 * t) * line(t, pi / 2); };
  // The steady part of it is the model's own: 1 - its share is what may be left.
  const double mean = [] {
    double sum = 0;
    for (const double t : times()) sum += std::sin(0.3 * t) / n;
    return sum;
  }();
  double squares = 0;
  for (const double t : times()) squares += std::pow(std::sin(0.3 * t), 2) / n;
  EXPECT_NEAR(left_of(turned), mean * mean / squares, 0.01);
  EXPECT_LT(left_of([](double t) { return (t - 8) * line(t, 0.2); }), 1e-3) << "a straight line about its middle";
}

TEST(Wander, HarmonicsWanderWithIt) {
  const auto third = [](double t) { return (t - 8) * std::sin(6 * pi * hertz * t); };
  EXPECT_GT(left_of(third, 1), 0.99);
  EXPECT_LT(left_of(third, 3), 1e-3);
}

TEST(Wander, OtherSignalsStay) {
  EXPECT_GT(left_of([](double t) { return std::sin(2 * pi * 47 * t); }), 0.99);
  EXPECT_GT(left_of([](double t) { return std::exp(-t); }), 0.999);
  EXPECT_GT(left_of([](double t) { return t > 7 ? 1.0 : 0.0; }), 0.999);
}

TEST(Wander, FewRowsAreNotGivenAway) {
  const auto t = times();
  EXPECT_EQ(LineSpan(std::span(t).first(70), {hertz, 1}).knots(), 0u);
  EXPECT_EQ(LineSpan({}, {hertz, 1}).knots(), 0u);
  EXPECT_EQ(LineSpan(std::span(t).first(1), {hertz, 1}).knots(), 0u);
  std::vector<double> rows(70, 1.0);
  LineSpan(std::span(t).first(70), {hertz, 1}).take_out(rows, Part::all);
  EXPECT_EQ(rows, std::vector<double>(70, 1.0));
}

TEST(Wander, ItTakesAsManyNumbersAsItHas) {
  // The squares that a projection takes from all unit rows together are the number of its dimensions.
  const auto t = times();
  const LineSpan span(t, {hertz, 1});
  EXPECT_EQ(span.knots(), 6u);
  double of_all = 0, of_wandering = 0;
  std::vector<double> rows(n);
  for (std::size_t i = 0; i < n; ++i)
    for (const Part part : {Part::all, Part::wandering}) {
      std::fill(rows.begin(), rows.end(), 0.0);
      rows[i] = 1;
      span.take_out(rows, part);
      (part == Part::all ? of_all : of_wandering) += 1 - squares_of(rows);
    }
  EXPECT_NEAR(of_all, 12, 1e-6) << "two waves at six knots";
  EXPECT_NEAR(of_wandering, 10, 1e-6) << "less the steady line";
}

TEST(Wander, WhatWasTakenOutIsGone) {
  const auto t = times();
  const LineSpan span(t, {hertz, 2});
  std::vector<double> rows;
  for (const double x : t) rows.push_back(line(x, 0.1) * std::cos(x) + std::sin(7 * x));
  span.take_out(rows, Part::all);
  auto again = rows;
  span.take_out(again, Part::all);
  for (std::size_t i = 0; i < n; ++i) ASSERT_NEAR(again[i], rows[i], 1e-9);
}

TEST(Wander, ALineAtHalfTheSamplingHasNoSine) {
  std::vector<double> t, rows;
  for (int i = 0; i < 2000; ++i) {
    t.push_back(0.01 * i);
    rows.push_back(i % 2 == 0 ? 1 + 0.01 * i : -1 - 0.01 * i);
  }
  const double before = squares_of(rows);
  LineSpan(t, {50, 1}).take_out(rows, Part::all);
  EXPECT_LT(squares_of(rows), 1e-12 * before);
}

TEST(Wander, RowsNeedNotBeEven) {
  std::vector<double> t, rows;
  for (int i = 0; i < 4000; ++i) t.push_back(0.002 * i + 0.0007 * std::sin(i));
  for (const double x : t) rows.push_back((x - 4) * line(x, 0.4));
  const double before = squares_of(rows);
  LineSpan(t, {hertz, 1}).take_out(rows, Part::all);
  EXPECT_LT(squares_of(rows), 1e-12 * before) << "a straight line between all knots";
}

// --- rows too few for amplitude and phase: one angle ---------------------------------------------------------------

/// Twenty minutes in rows of 0.89 s, which show 49.84 Hz as 0.4 Hz.
std::vector<double> slow_times() {
  std::vector<double> t;
  for (int i = 0; i < 1350; ++i) t.push_back(0.89 * i);
  return t;
}

/// A mains of two harmonics that turns to and fro by 0.13 rad every 21 s, 2 mHz off what all recordings together say.
constexpr double of_all = 49.841, of_this = 49.8388;
double turning(double t, double hertz_now = of_this) {
  const double turn = 2 * pi * (hertz_now * t + 0.02 * std::sin(0.3 * t));
  return std::sin(turn + 0.4) + 0.2 * std::sin(3 * turn + 1);
}

/// Share of the squares of a signal that is left where that line is taken out.
double left_beside_it(const std::function<double(double)>& signal) {
  const auto t = slow_times();
  std::vector<double> shown, rows;
  for (const double x : t) {
    shown.push_back(turning(x));
    rows.push_back(signal(x));
  }
  const double before = squares_of(rows);
  LineSpan(t, {of_all, 3}, {shown, 0.01}).take_out(rows, Part::all);
  return squares_of(rows) / before;
}

TEST(Wander, OneAngleFollowsALineThatItsRowsAreTooFewFor) {
  const auto t = slow_times();
  std::vector<double> shown, without, rows;
  for (const double x : t) shown.push_back(turning(x));
  rows = without = shown;
  const LineSpan blind(t, {of_all, 3}), seeing(t, {of_all, 3}, {shown, 0.01});
  blind.take_out(without, Part::all);
  seeing.take_out(rows, Part::all);
  EXPECT_GT(squares_of(without), 0.05 * squares_of(shown)) << "2.6 turns in eleven knots";
  // Knots every 5.3 s: straight lines miss (0.3*5.3)^2/27 of an angle of 0.09 rad (rms), 0.8 % of the line, and of the
  // third harmonic three times that of a fifth; the square of the angle is 0.4 %, half of which the waves have.
  EXPECT_LT(squares_of(rows), std::pow(0.014, 2) * squares_of(shown));
  EXPECT_LE(seeing.knots(), t.size() / 6);
}

TEST(Wander, WhatIsNotTheLineStaysInSlowRowsToo) {
  EXPECT_GT(left_beside_it([](double t) { return std::exp(-t / 200); }), 0.99) << "an expansion";
  EXPECT_GT(left_beside_it([](double t) { return t > 500 ? 1.0 : -1.0; }), 0.98);
  std::uint32_t seed = 1;
  const auto white = [&](double) {
    return static_cast<double>((seed = seed * 1664525u + 1013904223u) >> 8) / (1 << 24) - 0.5;
  };
  // A sixth of the rows, and six waves.
  EXPECT_NEAR(left_beside_it(white), 1 - 1.0 / 6 - 6.0 / 1350, 0.03);
}

TEST(Wander, ALineThatLooksSlowOrIsNoMoreThanNoiseIsNotFollowed) {
  const auto t = slow_times();
  const auto knots = [&](double about, double white) {
    std::vector<double> shown;
    for (const double x : t) shown.push_back(turning(x, about));
    return LineSpan(t, {about, 3}, {shown, white}).knots();
  };
  const std::size_t few = LineSpan(t, {of_all, 3}).knots();
  EXPECT_GT(knots(of_all, 0.1), few);
  EXPECT_EQ(knots(of_all, 0.5), 2u) << "a line of 0.7 (rms) has its own frequency, and no more";
  EXPECT_EQ(knots(of_all, 5), few) << "its 1350 rows are 27 of chi2";
  EXPECT_EQ(knots(45 / 0.89 + 0.001, 0.1), few) << "45 turns to a row: it looks as if it turned once in 1000 s";
}

TEST(Wander, WhatAModelHasDrawnAtItsOwnFrequencyGoesWithTheLine) {
  const auto t = slow_times();
  std::vector<double> shown, rows;
  for (const double x : t) {
    shown.push_back(turning(x));
    rows.push_back(turning(x) - 0.5 * std::sin(2 * pi * of_all * x + 0.3));
  }
  const double before = squares_of(rows);
  LineSpan(t, {of_all, 3}, {shown, 0.01}).take_out(rows, Part::all);
  EXPECT_LT(squares_of(rows), std::pow(0.014, 2) * before) << "see OneAngleFollows";
}

TEST(Wander, ALineMayBeAsFarOffAsTheOthersLeaveOpen) {
  const auto t = slow_times();
  std::vector<double> shown, rows;
  for (const double x : t) shown.push_back(turning(x, of_all - 0.09));
  const auto left = [&](double astray) {
    rows = shown;
    LineSpan(t, {of_all, 3}, {shown, 0.01, astray}).take_out(rows, Part::all);
    return squares_of(rows) / squares_of(shown);
  };
  EXPECT_GT(left(mains_astray), 0.1) << "half a turn between two knots is no straight line";
  EXPECT_LT(left(0.12), std::pow(0.014, 2)) << "see OneAngleFollows";
}

TEST(Wander, HowWellRowsKnowAFrequencyIsTheScatterOfWhatTheySay) {
  // A third of a second of a mains of 1.5 times the noise, 400 times.
  constexpr double mains = 50, white = 0.7;
  std::vector<double> t;
  for (int i = 0; i < 1500; ++i) t.push_back(0.00022 * i);
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0, white);
  double squares = 0, known = 0;
  constexpr int tries = 400;
  for (int k = 0; k < tries; ++k) {
    std::vector<double> rows;
    for (const double x : t)
      rows.push_back(1.5 * std::sqrt(2) * white * std::sin(2 * pi * mains * x + k) + noise(random));
    const auto sine = strongest_about(t, rows, mains, 1, [](double) { return true; });
    squares += std::pow(sine.frequency - mains, 2);
    known += known_frequency(t, rows, mains, white);
  }
  // The standard deviation of 400 is known to 3.5 %.
  EXPECT_NEAR(std::sqrt(squares / tries), 1 / std::sqrt(known / tries), 0.1 / std::sqrt(known / tries));
  std::vector<double> slow;
  for (int i = 0; i < 1500; ++i) slow.push_back(0.02 * i);
  EXPECT_EQ(known_frequency(slow, std::vector<double>(1500, 1.0), mains, white), 0) << "rows that do not resolve it";
}

TEST(Wander, OfALineThatTurnsTheSteadyPartIsTheModelsOwn) {
  const auto t = slow_times();
  std::vector<double> shown, rows;
  for (const double x : t) {
    shown.push_back(turning(x));
    rows.push_back(std::sin(2 * pi * of_all * x + 0.7));
  }
  const double before = squares_of(rows);
  LineSpan(t, {of_all, 3}, {shown, 0.01}).take_out(rows, Part::wandering);
  EXPECT_GT(squares_of(rows), 0.5 * before) << "what the model draws as steady is not taken out of it twice";
}

}  // namespace
}  // namespace hysteron
