// Decides noise of a given bandwidth: white numbers at even instants, held or joined by cubic B-splines. Does not draw
// the numbers: models/random.h.
#pragma once

#include <cmath>
#include <cstdint>

#include "models/number.h"
#include "models/random.h"

namespace hysteron::noise {

/// Bandwidth times the time between two numbers where the power has fallen by half: sinc(x)^2 = 1/2 for held numbers,
/// sinc(x)^8 = 1/2 for joined ones; sinc(x) = sin(pi x)/(pi x).
inline constexpr double held_bandwidth = 0.4429464706894523, joined_bandwidth = 0.22751195773449737;

/// The mean of the sum of squares of the weights below, 151/315: the cubic B-spline's own autocorrelation at zero.
inline constexpr double mean_square = 151.0 / 315;

/// Number `k` of the noise, any whole number: standard normal.
inline double number(std::uint64_t seed, std::uint64_t stream, double k) {
  return random::normal(seed, stream, static_cast<std::uint64_t>(static_cast<std::int64_t>(k)));
}

/// Twice differentiable noise of mean 0 and mean square 1 at the place `x`, in distances of two numbers: cubic
/// B-splines weighted by them. Power density 2 T sinc(f T)^8/mean_square. Source: de Boor, A Practical Guide to Splines
/// (1978), chapter IX; Unser, IEEE Signal Process. Mag. 16 (1999) 22-38.
template <class T>
T joined(const T& x, std::uint64_t seed, std::uint64_t stream) {
  const double k = std::floor(plain(x));
  const T s = x - T{k}, r = T{1} - s;
  const auto n = [&](double i) { return T{number(seed, stream, k + i)}; };
  const T inner = s * s * (T{0.5} * s - T{1}) + T{2.0 / 3}, outer = r * r * (T{0.5} * r - T{1}) + T{2.0 / 3};
  return (n(-1) * r * r * r / T{6} + n(0) * inner + n(1) * outer + n(2) * s * s * s / T{6}) / T{std::sqrt(mean_square)};
}

}  // namespace hysteron::noise
