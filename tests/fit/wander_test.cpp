// What a known line may do beside being steady: that is left out, and nothing else.
#include "fit/wander.h"

#include <gtest/gtest.h>

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

enum class Part { wandering, all };

/// Share of the squares of a signal that is left, whitened against white and a little 1/f noise.
double left_of(const std::function<double(double)>& signal, int harmonics = 1, Part part = Part::wandering) {
  const Whitener whitener(n, 0.1, 0.3, false);
  const auto t = times();
  const LineColumns columns = line_columns(t, {hertz, harmonics}, whitener);
  std::vector<double> rows, w(whitener.size());
  for (const double x : t) rows.push_back(signal(x));
  whitener.apply(rows, w.data());
  const double before = dot(w.data(), w.data(), w.size());
  clear_of(columns.wandering, w.data());
  if (part == Part::all) clear_of(columns.steady, w.data());
  return dot(w.data(), w.data(), w.size()) / before;
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
  const std::span<const double> few = std::span(t).first(70);
  const auto of_few = line_columns(few, {hertz, 1}, Whitener(70, 1, 0.3, false));
  EXPECT_EQ(of_few.steady.cols + of_few.wandering.cols, 0u);
  const Whitener all(n, 1, 0, true, Whitener::Order::any);
  EXPECT_EQ(line_columns(t, {hertz, 1}, all).wandering.cols, 2 * (6 - 1))
      << "six knots of two waves, less the steady line";
  EXPECT_EQ(line_columns({}, {hertz, 1}, Whitener()).wandering.cols, 0u);
}

}  // namespace
}  // namespace hysteron
