// Decides the coupled TAPI model: n inputs, each of which moves every output through a TAPI branch of its own, and the
// inputs that give wanted outputs. Does not decide a branch: tapi.h.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "models/hysteresis/play.h"
#include "models/hysteresis/tapi.h"
#include "models/number.h"

namespace hysteron::coupled_tapi {

/// Most axes that input_for() takes.
inline constexpr std::size_t most_axes = 8;

/// n axes, m operators per input with the same thresholds, the first 0. Branch (j, i) leads from input i to output j
/// and stands at j n + i, as in a matrix of one row per output; its m weights stand from (j n + i) m on.
template <class T>
struct Params {
  std::span<const T> thresholds;  ///< [V]    m
  std::span<const T> weights;     ///< [um/V] n n m
  std::span<const T> p_s;         ///< [um]   n n, saturation of each branch at 0 K
  std::span<const T> beta;        ///< [-]    n n
  std::span<const T> a;           ///< [V/K]  n n
  T t_c{1};                       ///< [K]

  std::size_t axes() const { return static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(p_s.size())))); }
  std::span<const T> branch(std::size_t j, std::size_t i) const {
    return weights.subspan((j * axes() + i) * thresholds.size(), thresholds.size());
  }
  /// The law of one branch as tapi.h takes it: its saturation is an input, that of the thesis in 5.26 an output.
  tapi::Params<T> law(std::size_t j, std::size_t i) const {
    const std::size_t at = j * axes() + i;
    return {p_s[at] / branch(j, i)[0], t_c, beta[at], a[at]};
  }
};

/// What input i alone adds to output j, from the memory before (m operators of that input):
///
///   y_j(u_i, T) = P_s (1 - T/T_c)^beta tanh(u_i/(a T)) + sum_k c_k w_k
///
/// Source: thesis Eq. 5.26.
template <class T>
T branch_at(const Params<T>& p, std::size_t j, std::size_t i, std::span<const T> before, const T& u,
            const T& temperature) {
  const std::size_t at = j * p.axes() + i;
  T y = tapi::polarisation(tapi::Params<T>{p.p_s[at], p.t_c, p.beta[at], p.a[at]}, u, temperature);
  const auto c = p.branch(j, i);
  for (std::size_t k = 0; k < c.size(); ++k) y += c[k] * play::follow_one_sided(p.thresholds[k], before[k], u);
  return y;
}

/// Operators of input i in the memory of all inputs.
template <class T>
std::span<const T> operators_of(const Params<T>& p, std::span<const T> memory, std::size_t i) {
  return memory.subspan(i * p.thresholds.size(), p.thresholds.size());
}

/// y_j = sum_i y_j(u_i, T). Source: thesis Eq. 5.27.
template <class T>
void outputs(const Params<T>& p, std::span<const T> memory, std::span<const T> u, const T& temperature, T* y) {
  const std::size_t n = p.axes();
  for (std::size_t j = 0; j < n; ++j) {
    y[j] = T{0};
    for (std::size_t i = 0; i < n; ++i) y[j] += branch_at(p, j, i, operators_of(p, memory, i), u[i], temperature);
  }
}

/// d y_j/d u_i at u, from the memory before.
inline double slope_at(const Params<double>& p, std::size_t j, std::size_t i, std::span<const double> before, double u,
                       double temperature) {
  const std::size_t at = j * p.axes() + i;
  const double bend = p.a[at] * temperature, h = std::tanh(u / bend);
  const double saturated = tapi::saturation(tapi::Params<double>{p.p_s[at], p.t_c, p.beta[at], p.a[at]}, temperature);
  double slope = saturated / bend * (1 - h * h);
  const auto c = p.branch(j, i);
  for (std::size_t k = 0; k < c.size(); ++k)
    if (u - p.thresholds[k] >= before[k] || u <= before[k]) slope += c[k];
  return slope;
}

/// x with a x = b, in place of b: Gaussian elimination with row pivots, a of n rows in plain numbers, b any scalar.
template <class T>
void eliminate(std::size_t n, double* a, T* b) {
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::fabs(a[i * n + k]) > std::fabs(a[best * n + k])) best = i;
    for (std::size_t i = 0; i < n; ++i) std::swap(a[k * n + i], a[best * n + i]);
    std::swap(b[k], b[best]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double share = a[i * n + k] / a[k * n + k];
      for (std::size_t j = k; j < n; ++j) a[i * n + j] -= share * a[k * n + j];
      b[i] -= T{share} * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= T{a[k * n + j]} * b[j];
    b[k] /= T{a[k * n + k]};
  }
}

/// Every axis on its own: u_j from P_jj^-1 of what is left of y_j when the branches of the other axes are taken away
/// (`coupled`) or nothing is (not coupled: what a compensator of single axes does).
enum class Axes { coupled, single };

/// The inputs whose outputs are y, from the memory before: axis after axis with the newest of the others, the memory
/// frozen, until nothing moves any more. The thesis solves each axis by the iteration of Fig. 5.8, this one within
/// bounds: it needs no weak saturation, only that each output hangs on its own input more than on the others together.
/// Not a number where that fails. `u`: the inputs before on the way in, the answer on the way out. Returns the sweeps.
/// Source: thesis Eqs. 5.28 to 5.31.
inline int input_for(const Params<double>& p, std::span<const double> memory, std::span<const double> y,
                     double temperature, Axes axes, double* u) {
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  constexpr int most_sweeps = 400;
  const std::size_t n = p.axes();
  for (int sweep = 1; sweep <= most_sweeps; ++sweep) {
    double moved = 0, size = 0;
    for (std::size_t j = 0; j < n; ++j) {
      double own = y[j];
      for (std::size_t k = 0; k < n && axes == Axes::coupled; ++k)
        if (k != j) own -= branch_at<double>(p, j, k, operators_of(p, memory, k), u[k], temperature);
      const double next =
          tapi::input_for(p.law(j, j), p.thresholds, p.branch(j, j), operators_of(p, memory, j), own, temperature);
      moved = std::max(moved, std::fabs(next - u[j]));
      size = std::max(size, std::fabs(next));
      u[j] = next;
    }
    if (moved <= rounding * size || axes == Axes::single) return sweep;
  }
  for (std::size_t j = 0; j < n; ++j) u[j] = std::numeric_limits<double>::quiet_NaN();
  return most_sweeps;
}

}  // namespace hysteron::coupled_tapi
