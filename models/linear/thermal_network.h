// Decides heat flow between n bodies and their surroundings: the rate of each temperature, and the equilibrium.
// Does not decide where the heat comes from.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "models/linear/linear_system.h"

namespace hysteron::thermal_network {

/// Conductances between n bodies: (1,2), (1,3) ... (1,n), (2,3) ... (n-1,n).
constexpr std::size_t pairs(std::size_t bodies) { return bodies * (bodies - 1) / 2; }
/// Place of the pair i < j in that order.
constexpr std::size_t pair_at(std::size_t bodies, std::size_t i, std::size_t j) {
  return i * bodies - i * (i + 1) / 2 + (j - i - 1);
}

/// One network: spans of n, n and pairs(n) numbers.
template <class T>
struct Network {
  std::span<const T> capacities;  ///< [J/K]
  std::span<const T> to_ambient;  ///< [W/K]
  std::span<const T> between;     ///< [W/K] in the order of pairs()
};

/// dT_i/dt = (q_i + g_i (T_a - T_i) + sum_j g_ij (T_j - T_i))/C_i [K/s] for heat q [W], temperatures and ambient [K].
/// Without ambient exchange the sum of C_i dT_i/dt is the sum of q_i.
/// Source: Incropera, DeWitt, Fundamentals of Heat and Mass Transfer, 6th ed. (2007), chapter 5 (lumped capacities).
template <class T>
void rates(const Network<T>& net, std::span<const T> temperatures, std::span<const T> heat, const T& ambient, T* out) {
  const std::size_t n = net.capacities.size();
  for (std::size_t i = 0; i < n; ++i) {
    T flow = heat[i] + net.to_ambient[i] * (ambient - temperatures[i]);
    for (std::size_t j = 0; j < n; ++j) {
      if (j == i) continue;
      flow += net.between[i < j ? pair_at(n, i, j) : pair_at(n, j, i)] * (temperatures[j] - temperatures[i]);
    }
    out[i] = flow / net.capacities[i];
  }
}

/// Temperatures [K] at which nothing flows any more; not a number where a body has no way to the ambient.
inline void rest(const Network<double>& net, std::span<const double> heat, double ambient, double* out) {
  const std::size_t n = net.capacities.size();
  std::vector<double> a(n * n, 0.0), b(heat.begin(), heat.end());  // a (T - T_a) = q
  for (std::size_t i = 0; i < n; ++i) {
    a[i * n + i] += net.to_ambient[i];
    for (std::size_t j = i + 1; j < n; ++j) {
      const double g = net.between[pair_at(n, i, j)];
      a[i * n + i] += g;
      a[j * n + j] += g;
      a[i * n + j] -= g;
      a[j * n + i] -= g;
    }
  }
  const bool solved = linear_system::solve(a, b);
  for (std::size_t i = 0; i < n; ++i) out[i] = solved ? ambient + b[i] : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace hysteron::thermal_network
