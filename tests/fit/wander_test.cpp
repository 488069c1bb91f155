// What a known line may do beside being steady: that is left out, and nothing else.
#include "fit/wander.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

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

}  // namespace
}  // namespace hysteron
