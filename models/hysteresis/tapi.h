// Decides the temperature-dependent asymmetric Prandtl-Ishlinskii model (TAPI): its memoryless saturating part, the
// whole output, and the input that gives a wanted output. Does not identify it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "models/hysteresis/play.h"
#include "models/hysteresis/prandtl_ishlinskii.h"
#include "models/number.h"

namespace hysteron::tapi {

/// Units for an input in V; any other works alike. Temperatures are absolute.
template <class T>
struct Params {
  T p_s{1};   ///< [V]    saturation at 0 K
  T t_c{1};   ///< [K]    Curie temperature: nothing is left of the saturation there
  T beta{1};  ///< [-]    how steeply it falls towards it
  T a{1};     ///< [V/K]  bend of the curve: a T is the input over which it bends
};

/// P_s(T) = P_s(0) (1 - T/T_c)^beta, 0 from T_c on. Source: thesis Eq. 5.14.
template <class T>
T saturation(const Params<T>& p, const T& temperature) {
  using std::exp;
  using std::log;
  const T left = T{1} - temperature / p.t_c;
  if (!(plain(left) > 0)) return T{0};
  return p.p_s * exp(p.beta * log(left));
}

/// P_s(T) tanh(u/(a T)) [V]: times the linear weight it is the memoryless part P_c of the output. Source: thesis Eq.
/// 5.15.
template <class T>
T polarisation(const Params<T>& p, const T& u, const T& temperature) {
  using std::tanh;
  return saturation(p, temperature) * tanh(u / (p.a * temperature));
}

/// y = c_1 P_s(T) tanh(u/(a T)) + sum c_i w_i over advanced one-sided operators, the first of threshold 0 (the linear
/// part). What the temperature changes has no memory: the loop area does not depend on it. Source: thesis Eq. 5.15.
template <class T>
T output(const Params<T>& p, std::span<const T> weights, std::span<const T> operators, const T& u,
         const T& temperature) {
  return weights[0] * polarisation(p, u, temperature) + prandtl_ishlinskii::output(weights, operators);
}

/// Output that an input u would give, from the memory before it.
template <class T>
T output_at(const Params<T>& p, std::span<const T> thresholds, std::span<const T> weights, std::span<const T> before,
            const T& u, const T& temperature) {
  T y = weights[0] * polarisation(p, u, temperature);
  for (std::size_t i = 0; i < weights.size(); ++i)
    y += weights[i] * play::follow_one_sided(thresholds[i], before[i], u);
  return y;
}

/// d(output_at)/du: the memoryless part, and the operators that move.
inline double slope_at(const Params<double>& p, std::span<const double> thresholds, std::span<const double> weights,
                       std::span<const double> before, double u, double temperature) {
  const double bend = p.a * temperature, h = std::tanh(u / bend);
  double slope = weights[0] * saturation(p, temperature) / bend * (1 - h * h);
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (u - thresholds[i] >= before[i] || u <= before[i]) slope += weights[i];
  return slope;
}

/// The input whose output is y, from the memory before it: Newton's method between bounds that hold the answer, so it
/// converges for any P_s/(a T), where the iteration of the thesis (Fig. 5.8) needs P_s/(a T) < 1. Needs rising slopes
/// (rising_slopes of the weights). Not a number where y cannot be reached.
inline double input_for(const Params<double>& p, std::span<const double> thresholds, std::span<const double> weights,
                        std::span<const double> before, double y, double temperature) {
  constexpr double rounding = 2 * std::numeric_limits<double>::epsilon();
  const auto miss = [&](double u) { return output_at(p, thresholds, weights, before, u, temperature) - y; };
  double u = before[0];  // the operator of threshold 0 is the last input
  double f = miss(u);
  if (f == 0) return u;
  // The slope is nowhere below that of the linear part alone, or below the smallest sum of weights.
  double low = u, high = u;
  for (double way = std::fabs(f) / weights[0]; std::isfinite(way); way *= 2) {
    (f > 0 ? low : high) = f > 0 ? u - way : u + way;
    if ((miss(f > 0 ? low : high) > 0) != (f > 0)) break;
  }
  for (int i = 0; i < 200; ++i) {
    double next = u - f / slope_at(p, thresholds, weights, before, u, temperature);
    if (!(next > low && next < high)) next = (low + high) / 2;
    const double way = std::fabs(next - u);
    u = next;
    f = miss(u);
    (f > 0 ? high : low) = u;
    if (f == 0 || way <= rounding * std::fabs(u) || high - low <= rounding * std::fabs(u)) return u;
  }
  return u;
}

/// The iteration of the thesis (Fig. 5.8): u <- P^-1[y - P_c(u)], the memory frozen, `steps` times from the last input
/// on or until it moves by no more than `tolerance`. Converges for P_s(T)/(a T) < 1 only, by that factor per step:
/// what feeds back is P_c with all of its slope, at u = 0. Takes the number of steps back in `steps`.
inline double iterated_input(const Params<double>& p, std::span<const double> thresholds,
                             std::span<const double> weights, std::span<const double> before, double y,
                             double temperature, int& steps, double tolerance = 0) {
  Params<double> classical = p;
  classical.p_s = 0;
  double u = before[0];
  for (int i = 0; i < steps; ++i) {
    const double rest = y - weights[0] * polarisation(p, u, temperature);
    const double next = input_for(classical, thresholds, weights, before, rest, temperature);
    const double way = std::fabs(next - u);
    u = next;
    if (way <= tolerance) steps = i + 1;
  }
  return u;
}

}  // namespace hysteron::tapi
