// Drives that were cut are told from drives that are flat by design.
#include "fit/signals/cut_tops.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "tests/fit/lab.h"

namespace hysteron {
namespace {

using std::numbers::pi;

std::vector<double> rows(std::size_t n, const std::function<double(double)>& value) {
  std::vector<double> list;
  for (std::size_t i = 0; i < n; ++i) list.push_back(value(static_cast<double>(i)));
  return list;
}
double sine(double row) { return std::sin(2 * pi * row / 123.4); }
/// Beats between 0.4 and 1.6: tops of many heights.
double beats(double row) { return sine(row) * (1 + 0.6 * std::sin(2 * pi * row / 1700)); }
/// Schroeder's phases: twelve lines, from -0.75 to 0.62.
double multisine(double row) {
  double sum = 0;
  for (int k = 1; k <= 12; ++k) sum += std::cos(2 * pi * k * row / 1000 - pi * k * (k - 1) / 12) / 6;
  return sum;
}
double triangle(double row, double period = 200) {
  return 4 * std::abs(row / period - std::floor(row / period + 0.5)) - 1;
}
double limited(double x, double limit) { return std::clamp(x, -limit, limit); }

TEST(CutTops, OfASineAreToldWithTheHeightThatItWouldHave) {
  for (const double limit : {0.95, 0.8, 0.5}) {
    const auto u = rows(4050, [&](double i) { return 5 + 2 * limited(sine(i), limit); });
    const CutTops top = cut_at_top(u, 0, 123.4), bottom = cut_at_bottom(u, 0, 123.4);
    EXPECT_TRUE(top.found && bottom.found) << limit;
    EXPECT_EQ(top.tops, 33U);  // one each 123.4 rows, the first at the 31st
    EXPECT_NEAR(top.level, 5 + 2 * limit, 1e-9);
    // The middle of a flat is known to less than a tenth of a row, which shifts the sine by as much: 2 (w / 10)^2 / 2.
    EXPECT_NEAR(top.would_be, 7, 1e-3) << limit;
    EXPECT_NEAR(bottom.would_be, 3, 1e-3) << limit;
  }
}

TEST(CutTops, OfBeatsAndOfAMultisineAreTold) {
  EXPECT_TRUE(cut_at_top(rows(6000, [](double i) { return std::min(beats(i), 1.2); }), 0, 0).found);
  EXPECT_FALSE(cut_at_bottom(rows(6000, [](double i) { return std::min(beats(i), 1.2); }), 0, 0).found);
  const auto u = rows(6000, [](double i) { return std::min(multisine(i), 0.55); });
  EXPECT_TRUE(cut_at_top(u, 0, 0).found);
  EXPECT_FALSE(cut_at_bottom(u, 0, 0).found);
}

TEST(CutTops, AreToldThroughAConverterAndThroughNoise) {
  lab::Noise random(1);
  const auto coarse = rows(6000, [](double i) { return 1e-3 * std::round(limited(beats(i), 1.2) / 1e-3); });
  EXPECT_TRUE(cut_at_top(coarse, 1e-3, 0).found);
  const auto noisy = rows(6000, [&](double i) { return limited(beats(i), 1.2) + 1e-3 * random(); });
  const CutTops top = cut_at_top(noisy, 0, 0);
  EXPECT_TRUE(top.found);
  EXPECT_NEAR(top.level, 1.2, 8e-3);  // the rows at the level, and those that come near it by the noise
}

TEST(CutTops, AreNoneWhereNothingIsCut) {
  lab::Noise random(2);
  for (const double step : {0.0, 1e-4, 0.01, 0.1})
    for (const double noise : {0.0, 1e-3, 0.02}) {
      const auto seen = [&](double x) {
        x += noise * random();
        return step > 0 ? step * std::round(x / step) : x;
      };
      EXPECT_FALSE(cut_at_top(rows(6000, [&](double i) { return seen(sine(i)); }), step, 123.4).found) << step << noise;
      EXPECT_FALSE(cut_at_top(rows(6000, [&](double i) { return seen(beats(i)); }), step, 0).found) << step << noise;
      EXPECT_FALSE(cut_at_top(rows(6000, [&](double i) { return seen(multisine(i)); }), step, 0).found)
          << step << noise;
      EXPECT_FALSE(cut_at_top(rows(6000, [&](double i) { return seen(triangle(i)); }), step, 200).found)
          << step << noise;
    }
}

TEST(CutTops, AreNoneWhereFlatTopsWereMeant) {
  const auto slow = [](double i) { return sine(i / 10); };
  double lag = 0, level = 0;
  lab::Noise random(3);
  const std::vector<std::pair<const char*, std::function<double(double)>>> drives{
      {"square", [](double i) { return std::fmod(i, 200) < 100 ? 1.0 : 0.0; }},
      {"square behind a lag", [&](double i) { return lag += 0.1 * ((std::fmod(i, 200) < 100 ? 1.0 : 0.0) - lag); }},
      {"trapezoid", [](double i) { return limited(2 * triangle(i), 1); }},
      {"trapezoid with short flanks", [](double i) { return limited(12 * triangle(i), 1); }},
      {"trapezoid with one steep flank",
       [](double i) {
         return std::clamp(std::fmod(i, 200) < 150 ? std::fmod(i, 200) / 60 : 5 - std::fmod(i, 200) / 40, 0.0, 1.0);
       }},
      {"halves of a cosine with holds",
       [](double i) {
         const double at = std::fmod(i, 400);
         return at < 100   ? (1 - std::cos(pi * at / 100)) / 2
                : at < 200 ? 1
                : at < 300 ? (1 + std::cos(pi * (at - 200) / 100)) / 2
                           : 0;
       }},
      {"a sine that the generator holds", [&](double i) { return slow(100 * std::floor(i / 100)); }},
      {"stairs", [](double i) { return std::floor(std::abs(std::fmod(i, 1000) - 500) / 50); }},
      {"random levels",
       [&](double i) { return level = std::fmod(i, 40) == 0 ? std::floor(5 * random.uniform()) : level; }},
      {"triangles", [](double i) { return triangle(i); }}};
  for (const auto& [name, drive] : drives)
    for (const double noise : {0.0, 1e-3}) {
      lag = 0;
      const auto u = rows(6000, [&](double i) { return drive(i) + noise * random(); });
      for (const double cycle : {0.0, 200.0, 400.0}) {
        EXPECT_FALSE(cut_at_top(u, 0, cycle).found) << name << ", noise " << noise << ", cycle " << cycle;
        EXPECT_FALSE(cut_at_bottom(u, 0, cycle).found) << name << ", noise " << noise << ", cycle " << cycle;
      }
    }
}

}  // namespace
}  // namespace hysteron
