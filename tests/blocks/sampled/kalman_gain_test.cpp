// Gains of stationary Kalman filters: closed form of one state, and what the equation says for more.
#include "blocks/sampled/kalman_gain.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hysteron::blocks {
namespace {

using Numbers = std::vector<double>;

/// a b, a being n x m and b m x k, row by row.
Numbers product(const Numbers& a, const Numbers& b, std::size_t n, std::size_t m, std::size_t k) {
  Numbers c(n * k, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < k; ++j)
      for (std::size_t l = 0; l < m; ++l) c[i * k + j] += a[i * m + l] * b[l * k + j];
  return c;
}
Numbers transposed(const Numbers& a, std::size_t rows, std::size_t columns) {
  Numbers t(a.size());
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) t[j * rows + i] = a[i * columns + j];
  return t;
}

TEST(KalmanGain, OfARandomWalkIsTheRootOfItsQuadratic) {
  // P^2/(P + R) = Q: P = (Q + sqrt(Q^2 + 4 Q R))/2, gain P/(P + R).
  const Numbers one{1}, r{2};
  for (const double noise : {1e-6, 0.1, 1.0, 40.0}) {
    const Numbers q{noise};
    const NoisyPlant plant{1, 1, one, one, q, r};
    const double p = (noise + std::sqrt(noise * noise + 8 * noise)) / 2;
    EXPECT_NEAR(prediction_covariance(plant)[0], p, 1e-12 * p);
    EXPECT_NEAR(kalman_gain(plant)[0], p / (p + 2), 1e-12);
  }
}

TEST(KalmanGain, SolvesItsEquation) {
  const Numbers a{1, 0.1, 0.005, 0, 1, 0.1, 0, -0.2, 0.9}, c{1, 0, 0, 0, 0, 1},
      q{2e-4, 1e-4, 0, 1e-4, 3e-3, 1e-3, 0, 1e-3, 0.1}, r{0.5, 0.1, 0.1, 0.2};
  const NoisyPlant plant{3, 2, a, c, q, r};
  const Numbers p = prediction_covariance(plant), l = kalman_gain(plant), at = transposed(a, 3, 3);
  const Numbers moved = product(product(a, p, 3, 3, 3), at, 3, 3, 3),
                seen = product(product(product(l, c, 3, 2, 3), p, 3, 3, 3), at, 3, 3, 3);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(moved[i] - seen[i] + q[i], p[i], 1e-13);  // numbers up to one
  // Errors die out: what is left of (1, 1, 1) behind a thousand instants.
  const Numbers pulled = product(l, c, 3, 2, 3);
  Numbers error{1, 1, 1}, step(9);
  for (std::size_t i = 0; i < 9; ++i) step[i] = a[i] - pulled[i];
  for (int k = 0; k < 1000; ++k) error = product(step, error, 3, 3, 1);
  for (const double e : error) EXPECT_LT(std::abs(e), 1e-6);
}

TEST(KalmanGain, IsNoNumberWhereNothingSettles) {
  const Numbers a{0.5, 0, 0, 1.1}, c{1, 0}, q{1, 0, 0, 1}, r{1}, none{0};
  EXPECT_TRUE(std::isnan(prediction_covariance({2, 1, a, c, q, r})[0])) << "a growing state that is not seen";
  EXPECT_TRUE(std::isnan(kalman_gain({2, 1, a, c, q, r})[0]));
  EXPECT_TRUE(std::isnan(kalman_gain({2, 1, a, c, q, none})[0])) << "no noise of the measurement";
}

}  // namespace
}  // namespace hysteron::blocks
