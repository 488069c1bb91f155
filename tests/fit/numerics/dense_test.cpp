// Coefficients of which something is known beforehand, against least squares with a row for each of them.
#include "fit/numerics/dense.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace hysteron {
namespace {

constexpr double anywhere = std::numeric_limits<double>::infinity();

double squared(const std::vector<double>& x) { return dot(x.data(), x.data(), x.size()); }

TEST(HeldColumns, LeaveWhatLeastSquaresWithARowForEachLeaves) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    const std::size_t rows = 30, cols = 1 + static_cast<std::size_t>(trial) % 6;
    Dense a(rows, cols);
    for (auto& x : a.a) x = normal(random);
    if (cols > 3)  // the outputs show only a combination
      for (std::size_t i = 0; i < rows; ++i) a(i, 3) = a(i, 0) - 2 * a(i, 1);
    std::vector<double> b(rows), sigma(cols);
    for (auto& x : b) x = normal(random);
    for (auto& s : sigma) s = trial % 3 == 0 && normal(random) > 0 ? anywhere : std::exp(2 * normal(random));

    const auto x = held_solution(a, sigma, b, 1e-10);
    std::vector<double> left = b;
    double known = 0;
    for (std::size_t j = 0; j < cols; ++j) {
      for (std::size_t i = 0; i < rows; ++i) left[i] -= a(i, j) * x[j];
      known += x[j] * x[j] / (sigma[j] * sigma[j]);
    }
    // At the least of |b - a x|^2 + sum (x/sigma)^2 its derivative vanishes: to rounding of numbers of some tens.
    for (std::size_t j = 0; j < cols; ++j)
      EXPECT_NEAR(dot(a.col(j), left.data(), rows), x[j] / (sigma[j] * sigma[j]), 1e-9) << trial << " " << j;
    std::vector<double> cleared = b;
    clear_of(held_basis(a, sigma, 1e-10), cleared.data());
    EXPECT_NEAR(squared(cleared), squared(left) + known, 1e-9 * squared(b)) << trial;
  }
}

TEST(HeldColumns, ThatNothingHoldsAreTakenOut) {
  Dense a(3, 1);
  a.a = {1, 2, 2};
  std::vector<double> b{1, 2, 3};
  clear_of(held_basis(a, {}, 1e-10), b.data());
  EXPECT_NEAR(b[0], 1 - 11.0 / 9, 1e-14);
  EXPECT_NEAR(b[2], 3 - 22.0 / 9, 1e-14);
}

}  // namespace
}  // namespace hysteron
