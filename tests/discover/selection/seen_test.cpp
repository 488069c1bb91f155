// Linear least squares of what numbers take away, beside what is known of them.
#include "discover/selection/seen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hysteron {
namespace {

Column random_column(std::size_t n, std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  Column c(n);
  for (double& v : c) v = normal(engine);
  return c;
}

double cost(const std::vector<Moving>& numbers, const Column& left, const std::vector<double>& change) {
  double sum = 0;
  for (std::size_t k = 0; k < left.size(); ++k) {
    double r = left[k];
    for (std::size_t i = 0; i < numbers.size(); ++i) r -= change[i] * numbers[i].takes_away[k];
    sum += r * r;
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) sum += numbers[i].known * std::pow(numbers[i].off + change[i], 2);
  return sum;
}

TEST(FitLinearly, OneNumberFollowsTheClosedForm) {
  const Moving one{{1, 2, 2}, 7, 0.5};  // |d|^2 = 9
  const LinearFit fit = fit_linearly({one}, {3, 0, 3});
  const double value = (9 - 7 * 0.5) / (9 + 7);  // (d'r - k off)/(d'd + k)
  EXPECT_NEAR(fit.value[0], value, 1e-14);
  EXPECT_NEAR(fit.sigma[0], 1 / std::sqrt(16.0), 1e-14);
  EXPECT_NEAR(fit.fall, cost({one}, {3, 0, 3}, {0}) - cost({one}, {3, 0, 3}, {value}), 1e-13);
}

TEST(FitLinearly, NoOtherChangeLeavesLess) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 50; ++i) {
    std::vector<Moving> numbers;
    for (int n = 0; n < 1 + i % 5; ++n)
      numbers.push_back({random_column(40, engine), n % 2 == 0 ? 0 : std::abs(normal(engine)), normal(engine)});
    const Column left = random_column(40, engine);
    const LinearFit fit = fit_linearly(numbers, left);
    const double best = cost(numbers, left, fit.value);
    // The fall is what the cost falls by from where the numbers stand; both sums have some hundred terms of size 1.
    EXPECT_NEAR(fit.fall, cost(numbers, left, std::vector<double>(numbers.size(), 0.0)) - best, 1e-10);
    for (int k = 0; k < 20; ++k) {
      auto other = fit.value;
      for (double& v : other) v += 0.1 * normal(engine);
      EXPECT_GT(cost(numbers, left, other), best);
    }
  }
}

TEST(FitLinearly, OfNumbersThatDoTheSameTheShortestChangeIsTaken) {
  const Column d{1, 1, 0};
  const LinearFit fit = fit_linearly({{d, 0, 0}, {d, 0, 0}, {{0, 0, 0}, 0, 0}}, {2, 2, 5});
  EXPECT_NEAR(fit.value[0], 1, 1e-12);
  EXPECT_NEAR(fit.value[1], 1, 1e-12);
  EXPECT_EQ(fit.value[2], 0);  // it moves nothing
  EXPECT_NEAR(fit.fall, 8, 1e-12);
}

}  // namespace
}  // namespace hysteron
