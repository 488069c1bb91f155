// Decides the gain of a stationary Kalman filter. Does not filter.
#pragma once

#include <span>
#include <vector>

namespace hysteron::blocks {

/// A plant x_(k+1) = A x_k + w, y = C x + v with cov(w) = Q (symmetric, not negative) and cov(v) = R (symmetric,
/// positive). All matrices row by row: A and Q states x states, C measured x states, R measured x measured.
struct NoisyPlant {
  int states = 0, measured = 0;
  std::span<const double> a, c, process_noise, measurement_noise;
};

/// Covariance of the error of the prediction where it has settled, P = A P A' - A P C' (C P C' + R)^-1 C P A' + Q, row
/// by row. By doubling: each round counts for as many instants as all before. Not a number where it does not settle (a
/// state that does not decay and is not seen). Source: Anderson, Moore, Optimal Filtering (1979), section 6.7.
std::vector<double> prediction_covariance(const NoisyPlant& plant);

/// L of x_(k+1) = A x_k + B u_k + L (y_k - C x_k - D u_k): A P C' (C P C' + R)^-1, states x measured, row by row.
/// Source: the same, section 4.1.
std::vector<double> kalman_gain(const NoisyPlant& plant);

}  // namespace hysteron::blocks
