// Decides the Jiles-Atherton law for polarisation: its slope on either branch, the rate law made of it, the inverse
// law, and both for a move of given size. Does not decide what field and polarisation stand for: as a displacement
// law the field is a voltage [V] and the polarisation a displacement [m].
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "models/number.h"
#include "models/path.h"

namespace hysteron::jiles_atherton {

/// The curve without pinning, over the effective field: tanh of the thesis, or Langevin's function, which published
/// sets of magnetic materials mean.
enum class Curve { tanh, langevin };

/// Units for a field in V and a polarisation in m; any other pair works alike.
template <class T>
struct Params {
  T p_s{1};    ///< [m]    saturation
  T a{1};      ///< [V]    field over which the anhysteretic curve bends
  T alpha{0};  ///< [V/m]  field that the polarisation adds to the applied one
  T k{1};      ///< [V]    pinning: width of the loop
  T c{0};      ///< [-]    reversible share, 0 <= c < 1
  Curve curve{Curve::tanh};
  bool past_upright{false};  ///< the formula is taken as it stands where it is no law any more, too
};

/// A curve at x: its value and its slope.
template <class T>
struct Bend {
  T value, slope;
};

/// L(x) = coth x - 1/x and L' = 1 - L^2 - 2 L/x, to some 1e-15 of themselves (L' beyond x = 1e3: of 1/3), near zero
/// too: there as x sum 2k x^(2k-2)/(2k+1)! over sum x^(2k)/(2k+1)! = sinh(x)/x, all of whose terms are positive.
/// Source: Langevin, Ann. Chim. Phys. 5 (1905) 70-127; Jiles, Atherton (below), Eq. 5.
template <class T>
Bend<T> langevin(const T& x) {
  using std::tanh;
  if (std::fabs(plain(x)) < 1) {
    const T y = x * x;
    T above{1.0 / 6758061133824000}, below{1.0 / 121645100408832000};
    for (const double c : {22230464256000.0, 93405312000.0, 518918400.0, 3991680.0, 45360.0, 840.0, 30.0, 3.0})
      above = T{1 / c} + y * above;
    for (const double c :
         {355687428096000.0, 1307674368000.0, 6227020800.0, 39916800.0, 362880.0, 5040.0, 120.0, 6.0, 1.0})
      below = T{1 / c} + y * below;
    const T over_x = above / below, value = x * over_x;
    return {value, T{1} - value * value - T{2} * over_x};
  }
  const T h = tanh(x), part = T{1} / x;
  return {T{1} / h - part, part * part - (T{1} - h * h) / (h * h)};
}

template <class T>
Bend<T> bend(Curve curve, const T& x) {
  using std::tanh;
  if (curve == Curve::langevin) return langevin(x);
  const T h = tanh(x);
  return {h, T{1} - h * h};
}

/// Polarisation without pinning: P_an = P_s A((E + alpha P)/a), A the curve. Source: thesis Eq. 2.23.
template <class T>
T anhysteretic(const Params<T>& p, const T& field, const T& polarisation) {
  return p.p_s * bend(p.curve, T{(field + p.alpha * polarisation) / p.a}).value;
}

/// Slope dP/dE = over/under of the branch with rising (direction d = 1) or falling (-1) field:
///
///   F = [ (P_an - P)/(k d - alpha/(1-c) (P_an - P)) + R ] / [ 1 - alpha R ],   R = (c P_s/a) A'((E + alpha P)/a)
///
/// as one fraction: with q = P_an - P, G = (1-c) k d - alpha q and s = c P_s A',
/// F = [ (1-c) a q + s G ]/[ G (a - alpha s) ].
/// The irreversible part is not cut off where it is negative: the parameters of the thesis hold for the law as it
/// stands. Odd: F(-E, -P, -d) = F(E, P, d). The law ends where G d falls to zero: the curve is upright there and would
/// turn back, so that no polarisation belongs to a field further on. a - alpha s is positive where reversible_margin
/// is. Source: thesis Eqs. 2.29 to 2.34, the reversible term by the chain rule (the printed one has a factor alpha too
/// many); Jiles, Atherton, J. Magn. Magn. Mater. 61 (1986) 48-60; Smith, Ounaies, J. Intell. Mater. Syst. Struct. 11
/// (2000) 62-79.
template <class T>
struct Slope {
  T over, under;
  bool holds;  ///< G d is positive; or the formula is taken as it stands: past_upright, or the set is refused anyway
               ///< (reversible_margin)
};
template <class T>
Slope<T> slope_fraction(const Params<T>& p, const T& field, const T& polarisation,
                        const std::type_identity_t<T>& direction) {
  const Bend<T> curve = bend(p.curve, T{(field + p.alpha * polarisation) / p.a});
  const T q = p.p_s * curve.value - polarisation;
  const T s = p.c * p.p_s * curve.slope;
  const T held = T{1} - p.c;
  const T g = direction * held * p.k - p.alpha * q, left = p.a - p.alpha * s;
  const double steepest = p.curve == Curve::langevin ? 1.0 / 3 : 1.0;  // slope of the curve at zero
  const bool refused = !(plain(p.a) > plain(p.alpha) * plain(p.c) * plain(p.p_s) * steepest);
  return {held * p.a * q + s * g, g * left, refused || p.past_upright || plain(g) * plain(direction) > 0};
}
template <class T>
T slope(const Params<T>& p, const T& field, const T& polarisation, const std::type_identity_t<T>& direction) {
  const Slope<T> f = slope_fraction(p, field, polarisation, direction);
  return f.over / f.under;
}

/// dP/dt for the rate of the field: F(E, P, sign v) v, not a number where the law has ended. Rate independent: scaling
/// v > 0 scales the answer alike.
template <class T>
T polarisation_rate(const Params<T>& p, const T& polarisation, const T& field, const T& field_rate) {
  const Slope<T> f = slope_fraction(p, field, polarisation, field_rate < T{0} ? T{-1} : T{1});
  return f.holds ? T{f.over / f.under * field_rate} : T{std::numeric_limits<double>::quiet_NaN()};
}

/// The inverse law: dE/dt that makes the polarisation change at the wanted rate, E the field to apply.
///
///   dE/dt = (dP/dt)/F(E, P, sign dP/dt)
///
/// Needs F > 0, where the field rises with the polarisation: not a number where it does not. Source: thesis Eq. 2.35.
template <class T>
T field_rate(const Params<T>& p, const T& field, const T& polarisation, const T& polarisation_rate) {
  const Slope<T> f = slope_fraction(p, field, polarisation, polarisation_rate < T{0} ? T{-1} : T{1});
  const bool rises = f.holds && plain(f.over) * plain(f.under) > 0;
  return polarisation_rate * (rises ? T{f.under / f.over} : T{std::numeric_limits<double>::quiet_NaN()});
}

/// Polarisation after a straight move of the field. Exact to `relative` of its way; not a number where the law ends.
template <class T>
T polarisation_after(const Params<T>& p, const T& polarisation, const T& from, const T& to,
                     double relative = path::tolerance) {
  const T move = to - from;
  return path::follow([&](double s, const T& at) { return polarisation_rate(p, at, T{from + T{s} * move}, move); },
                      polarisation, relative);
}

/// Field after a straight move of the wanted polarisation: the inverse of polarisation_after.
template <class T>
T field_after(const Params<T>& p, const T& field, const T& from, const T& to, double relative = path::tolerance) {
  const T move = to - from;
  return path::follow([&](double s, const T& at) { return field_rate(p, at, T{from + T{s} * move}, move); }, field,
                      relative);
}

/// The law whose polarisation is `scale` times that of p on the same field: P_s and alpha change, no other number does.
///
///   P_n = s P:  dP_n/dt = s F(E, P_n/s, d) dE/dt = F_n(E, P_n, d) dE/dt  with  P_s,n = s P_s, alpha_n = alpha/s
///
/// Source: thesis Eqs. 4.4 and 4.5 as corrected (normalised model), s = wanted stroke over the stroke of p.
template <class T>
Params<T> scaled(const Params<T>& p, const T& scale) {
  return {scale * p.p_s, p.a, p.alpha / scale, p.k, p.c, p.curve, p.past_upright};
}

/// 1 - alpha c P_s A'(0)/a: must be positive, else the reversible part runs away by itself at zero field. A'(0) = 1 of
/// tanh, 1/3 of Langevin's function.
template <class T>
T reversible_margin(const Params<T>& p) {
  return T{1} - p.alpha * p.c * p.p_s * bend(p.curve, T{0}).slope / p.a;
}

}  // namespace hysteron::jiles_atherton
