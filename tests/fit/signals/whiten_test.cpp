#include "fit/signals/whiten.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <thread>

#include "tests/fit/lab.h"

namespace hysteron {
namespace {

TEST(CosineTransform, IsTheOrthonormalOneOfItsDefinition) {
  // c_k = sqrt((2 - [k = 0]) / N) sum x_j cos(pi k (j + 1/2) / N), computed here term by term.
  for (const std::size_t n : {1U, 2U, 7U, 30U, 31U}) {
    lab::Noise random(static_cast<unsigned>(n));
    std::vector<double> x(n);
    for (double& v : x) v = random();
    auto c = x;
    cosine_transform(c);
    for (std::size_t k = 0; k < n; ++k) {
      double sum = 0;
      for (std::size_t j = 0; j < n; ++j)
        sum += x[j] * std::cos(std::numbers::pi * static_cast<double>(k) * (static_cast<double>(j) + 0.5) /
                               static_cast<double>(n));
      EXPECT_NEAR(c[k], std::sqrt((k == 0 ? 1.0 : 2.0) / static_cast<double>(n)) * sum, 1e-13);
    }
    inverse_cosine_transform(c);
    for (std::size_t j = 0; j < n; ++j) EXPECT_NEAR(c[j], x[j], 1e-13);
  }
}

TEST(CosineTransform, KeepsLengthsAtARowCountThatIsAPrime) {
  lab::Noise random(5);
  std::vector<double> x(10007);
  double before = 0, after = 0;
  for (double& v : x) {
    v = random();
    before += v * v;
  }
  cosine_transform(x);
  for (const double v : x) after += v * v;
  EXPECT_NEAR(after / before, 1, 1e-12);
}

TEST(CosineTransform, GivesTheSameNumbersInManyThreads) {
  std::vector<double> x(1000);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::sin(0.1 * static_cast<double>(i));
  auto expected = x;
  cosine_transform(expected);
  std::vector<std::vector<double>> got(4, x);
  {
    std::vector<std::jthread> threads;
    for (auto& g : got) threads.emplace_back([&g] { cosine_transform(g); });
  }
  for (const auto& g : got) EXPECT_EQ(g, expected);
}

// Rows that are not all as sure: lengths and products are those of the weighed rows without their weighed constant,
// which is taken out here by Gram and Schmidt; and the zero is the weighed mean.
TEST(Whitener, WeighsEachRowByItsOwnNoise) {
  lab::Noise random(3);
  for (const std::size_t n : {1U, 2U, 40U}) {
    std::vector<double> rms(n), x(n), y(n);
    for (std::size_t i = 0; i < n; ++i) rms[i] = std::exp(2 * random()), x[i] = random() + 5, y[i] = random() - 3;
    double wx = 0, wy = 0, w = 0, xy = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double weight = 1 / (rms[i] * rms[i]);
      w += weight, wx += weight * x[i], wy += weight * y[i], xy += weight * x[i] * y[i];
    }
    const auto product = [&](bool drop_zero) {
      const Whitener whitener(rms, drop_zero);
      std::vector<double> a(whitener.size()), b(whitener.size());
      whitener.apply(x, a.data());
      whitener.apply(y, b.data());
      double sum = 0;
      for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
      return sum;
    };
    const double scale = std::abs(xy) + std::abs(wx * wy / w);  // rounding of the sums
    EXPECT_NEAR(product(false), xy, 1e-12 * scale) << n;
    EXPECT_NEAR(product(true), xy - wx * wy / w, 1e-11 * scale) << n;
    EXPECT_NEAR(Whitener(rms, true).zero_of(x), wx / w, 1e-12 * std::abs(wx / w)) << n;
  }
}

/// White noise of rms `s` plus noise whose variance in cosine coefficient k is s^2 A / (k + 1/2), as whiten.h assumes.
std::vector<double> coloured(std::size_t n, double s, double share, unsigned seed) {
  lab::Noise random(seed);
  std::vector<double> c(n);
  const double a = share * share * static_cast<double>(n) / 7.9;
  for (std::size_t k = 0; k < n; ++k)
    c[k] = s * std::sqrt(1 + (k == 0 ? 4 * a : a / (static_cast<double>(k) + 0.5))) * random();
  inverse_cosine_transform(c);
  return c;
}

TEST(Whitener, MakesChiSquareOfItsOwnNoiseEqualToTheNumberOfRows) {
  // Sum of n squares of standard normal numbers: n +- 5 sqrt(2 n).
  const std::size_t n = 4000;
  const auto rows = coloured(n, 2e-9, 0.3, 3);
  const Whitener whitener(n, 2e-9, 0.3, false);
  std::vector<double> w(whitener.size());
  whitener.apply(rows, w.data());
  double chi2 = 0;
  for (const double v : w) chi2 += v * v;
  EXPECT_NEAR(chi2, static_cast<double>(n), 5 * std::sqrt(2.0 * static_cast<double>(n)));
}

TEST(Whitener, AShareOfThreeTenthsIsOneOverFNoiseOfThreeTenthsOfTheWhiteRms) {
  // Sum over k of 1/(k+1/2) is between 7 and 10 for one to twenty thousand rows; 7.9 stands for it.
  for (const std::size_t n : {1000U, 4000U, 20000U}) {
    double one_over_f = 0;
    for (std::size_t k = 1; k < n; ++k)
      one_over_f += 0.09 * static_cast<double>(n) / 7.9 / (static_cast<double>(k) + 0.5) / static_cast<double>(n);
    EXPECT_NEAR(std::sqrt(one_over_f), 0.3, 0.05) << n;
  }
}

TEST(Whitener, AConstantVanishesWhereTheZeroIsFreeAndIsSeenWhereItIsNot) {
  const std::vector<double> constant(100, 5.0);
  const Whitener shared(100, 1, 0, false), own(100, 1, 0, true);
  std::vector<double> w(100), v(99);
  shared.apply(constant, w.data());
  own.apply(constant, v.data());
  EXPECT_EQ(own.size(), 99U);
  EXPECT_NEAR(w[0], 50, 1e-12);  // 5 sqrt(100)
  for (const double x : v) EXPECT_NEAR(x, 0, 1e-12);
}

TEST(Whitener, WhiteNoiseInAnyOrderHasTheSameLengthsAndProducts) {
  lab::Noise random(3);
  for (const std::size_t n : {std::size_t{1}, std::size_t{2}, std::size_t{101}})
    for (const bool drop_zero : {false, true}) {
      Rows a, b;
      for (std::size_t i = 0; i < n; ++i) {
        a.push_back(5 + random());
        b.push_back(random() - 2);
      }
      const Whitener ordered(n, 0.1, 0, drop_zero), any(n, 0.1, 0, drop_zero, Whitener::Order::any);
      ASSERT_EQ(any.size(), ordered.size());
      std::vector<std::vector<double>> w(4, std::vector<double>(any.size()));
      ordered.apply(a, w[0].data());
      ordered.apply(b, w[1].data());
      any.apply(a, w[2].data());
      any.apply(b, w[3].data());
      double expected_aa = 0, expected_ab = 0, aa = 0, ab = 0;
      for (std::size_t i = 0; i < any.size(); ++i) {
        expected_aa += w[0][i] * w[0][i];
        expected_ab += w[0][i] * w[1][i];
        aa += w[2][i] * w[2][i];
        ab += w[2][i] * w[3][i];
      }
      // Orthonormal transforms of some hundred numbers of size 50: rounding.
      EXPECT_NEAR(aa, expected_aa, 1e-12 * (1 + expected_aa)) << n << drop_zero;
      EXPECT_NEAR(ab, expected_ab, 1e-12 * (1 + expected_aa)) << n << drop_zero;
    }
}

TEST(Whitener, SlowDriftCountsLessThanFastMotionOfTheSameSize) {
  const std::size_t n = 1000;
  std::vector<double> slow(n), fast(n), w(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double x = std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    slow[i] = std::cos(x);
    fast[i] = std::cos(500 * x);
  }
  const Whitener whitener(n, 1, 0.3, false);
  const auto chi2 = [&](const std::vector<double>& rows) {
    whitener.apply(rows, w.data());
    double sum = 0;
    for (const double v : w) sum += v * v;
    return sum;
  };
  // Coefficient 1: 1 + A/1.5 with A = 0.09 * 1000 / 7.9 = 11.39; coefficient 500: 1 + A/500.5. Both hold n/2 squares.
  const double a = 0.09 * 1000 / 7.9;
  EXPECT_NEAR(chi2(slow), 500 / (1 + a / 1.5), 1e-9);
  EXPECT_NEAR(chi2(fast), 500 / (1 + a / 500.5), 1e-9);
}

}  // namespace
}  // namespace hysteron
