// Decides the Bouc-Wen law: the rate of the hysteretic part for a given rate of the input.
// Does not integrate it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace hysteron::bouc_wen {

/// Units for an input in V and an output in m; any other pair works alike.
template <class T>
struct Params {
  T alpha{1};          ///< [m/V]  slope of z at z = 0
  T beta{0};           ///< [1/V]  loop shape, dissipative part
  T gamma{0};          ///< [1/V]  loop shape, conservative part
  T d_p{1};            ///< [m/V]  slope of the linear part
  double exponent{1};  ///< [-]    n >= 1: sharpness of the bend
  double scale{1};     ///< [m]    size of z for which beta and gamma are given; without effect for n = 1
};

/// Added to |z|/scale under the power: its slope alone has no bound at z = 0 for n < 2, that of the product is 0 there.
inline constexpr double least_size = std::numeric_limits<double>::min();

/// Rate of the hysteretic part z; the displacement is y = d_p u - z.
///
///   dz/dt = alpha v - (beta |v| z + gamma v |z|) |z/scale|^(n-1)
///
/// z [m] hysteretic part, v [V/s] rate of the input. With scale = 1 the printed law; the scale keeps the unit of beta
/// for every n. Rate independent: scaling v scales dz/dt alike. n = 1: |z| <= alpha/(beta + gamma) if beta > |gamma|.
/// Source: thesis Eqs. 2.36, 2.37; Ismail, Ikhouane, Rodellar, Arch. Comput. Methods Eng. 16 (2009) 161-188.
template <class T>
T z_rate(const Params<T>& p, const T& z, const T& v) {
  using std::abs;
  using std::pow;
  const T bend = p.beta * abs(v) * z + p.gamma * v * abs(z);
  if (p.exponent == 1) return p.alpha * v - bend;
  return p.alpha * v - bend * pow(abs(z) / T{p.scale} + T{least_size}, p.exponent - 1);
}

/// The hysteretic part [m] behind a way of the input [V] in one direction, from z: z_rate solved along the way, in
/// closed form for n = 1: an exponential before z passes 0, and another one behind. For other n there is none.
inline double z_in_closed_form(const Params<double>& p, double z, double way) {
  // y = z in the direction of the way, or against it where z pushes back: dy/ds = slope - bend y, slope >= 0.
  const double side = std::copysign(1.0, way) * std::copysign(1.0, p.alpha), slope = std::fabs(p.alpha);
  const double gamma = std::copysign(p.gamma, p.gamma * p.alpha);
  double y = side * z, left = std::fabs(way);
  const auto moved = [&](double bend, double length) {
    const double x = bend * length;
    // (1 - exp(-x))/x: a short row needs no more than five terms of it.
    const double share =
        std::fabs(x) < 0.02 ? 1 - x * (0.5 - x * (1.0 / 6 - x * (1.0 / 24 - x / 120))) : -std::expm1(-x) / x;
    const double reached = length * share;
    return y + (slope - bend * y) * reached;
  };
  if (y < 0) {
    const double bend = p.beta - gamma, grown = slope > 0 ? -bend * y / slope : -1;
    const double to_zero = slope == 0    ? std::numeric_limits<double>::infinity()
                           : bend == 0   ? -y / slope
                           : grown <= -1 ? std::numeric_limits<double>::infinity()
                                         : std::log1p(grown) / bend;
    if (to_zero >= left) return side * moved(bend, left);
    left -= to_zero;
    y = 0;
  }
  return side * moved(p.beta + gamma, left);
}

/// Whether every bounded input gives a bounded z, whatever came before: beta >= 0, else loops give energy and grow, and
/// beta + gamma sign(alpha) > 0, else nothing limits z. Both zero is a spring, z = alpha u. alpha = 0: beta >= |gamma|.
/// Source: Ismail, Ikhouane, Rodellar (above), Table 1.
inline bool is_bounded(const Params<double>& p) {
  if (p.beta == 0 && p.gamma == 0) return true;
  if (p.alpha == 0) return p.beta >= std::fabs(p.gamma);
  return p.beta >= 0 && p.beta + std::copysign(p.gamma, p.gamma * p.alpha) > 0;
}

/// Largest |z| for a rising input: alpha = (beta + gamma) z |z/scale|^(n-1) solved for z.
inline double limit(const Params<double>& p) {
  return p.scale * std::pow(p.alpha / ((p.beta + p.gamma) * p.scale), 1 / p.exponent);
}

}  // namespace hysteron::bouc_wen
