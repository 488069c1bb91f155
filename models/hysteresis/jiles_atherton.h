// Decides the Jiles-Atherton law for polarisation: its slope on either branch, the rate law made of it, the inverse
// law, and both for a move of given size. Does not decide what field and polarisation stand for: as a displacement
// law the field is a voltage [V] and the polarisation a displacement [m].
#pragma once

#include <cmath>
#include <type_traits>

#include "models/path.h"

namespace hysteron::jiles_atherton {

/// Units for a field in V and a polarisation in m; any other pair works alike.
template <class T>
struct Params {
  T p_s{1};    ///< [m]    saturation
  T a{1};      ///< [V]    field over which the anhysteretic curve bends
  T alpha{0};  ///< [V/m]  field that the polarisation adds to the applied one
  T k{1};      ///< [V]    pinning: width of the loop
  T c{0};      ///< [-]    reversible share, 0 <= c < 1
};

/// Polarisation without pinning: P_an = P_s tanh((E + alpha P)/a). Source: thesis Eq. 2.23.
template <class T>
T anhysteretic(const Params<T>& p, const T& field, const T& polarisation) {
  using std::tanh;
  return p.p_s * tanh((field + p.alpha * polarisation) / p.a);
}

/// Slope dP/dE = over/under of the branch with rising (direction d = 1) or falling (-1) field:
///
///   F = [ (P_an - P)/(k d - alpha/(1-c) (P_an - P)) + R ] / [ 1 - alpha R ],   R = (c P_s/a) sech^2((E + alpha P)/a)
///
/// as one fraction: with q = P_an - P, G = (1-c) k d - alpha q and s = c P_s sech^2,
/// F = [ (1-c) a q + s G ]/[ G (a - alpha s) ].
/// The irreversible part is not cut off where it is negative: the parameters of the thesis hold for the law as it
/// stands. Odd: F(-E, -P, -d) = F(E, P, d). There is no law where either bracket below is zero.
/// Source: thesis Eqs. 2.29 to 2.34, the reversible term by the chain rule (the printed one has a factor alpha too
/// many); Jiles, Atherton, J. Magn. Magn. Mater. 61 (1986) 48-60; Smith, Ounaies, J. Intell. Mater. Syst. Struct. 11
/// (2000) 62-79.
template <class T>
struct Slope {
  T over, under;
};
template <class T>
Slope<T> slope_fraction(const Params<T>& p, const T& field, const T& polarisation,
                        const std::type_identity_t<T>& direction) {
  using std::tanh;
  const T h = tanh((field + p.alpha * polarisation) / p.a);
  const T q = p.p_s * h - polarisation;
  const T s = p.c * p.p_s * (T{1} - h * h);
  const T held = T{1} - p.c;
  const T g = direction * held * p.k - p.alpha * q;
  return {held * p.a * q + s * g, g * (p.a - p.alpha * s)};
}
template <class T>
T slope(const Params<T>& p, const T& field, const T& polarisation, const std::type_identity_t<T>& direction) {
  const Slope<T> f = slope_fraction(p, field, polarisation, direction);
  return f.over / f.under;
}

/// dP/dt for the rate of the field: F(E, P, sign v) v. Rate independent: scaling v > 0 scales the answer alike.
template <class T>
T polarisation_rate(const Params<T>& p, const T& polarisation, const T& field, const T& field_rate) {
  return slope(p, field, polarisation, field_rate < T{0} ? T{-1} : T{1}) * field_rate;
}

/// The inverse law: dE/dt that makes the polarisation change at the wanted rate, E the field to apply.
///
///   dE/dt = (dP/dt)/F(E, P, sign dP/dt)
///
/// Needs F > 0, where the field rises with the polarisation. Source: thesis Eq. 2.35.
template <class T>
T field_rate(const Params<T>& p, const T& field, const T& polarisation, const T& polarisation_rate) {
  const Slope<T> f = slope_fraction(p, field, polarisation, polarisation_rate < T{0} ? T{-1} : T{1});
  return polarisation_rate * (f.under / f.over);
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
  return {scale * p.p_s, p.a, p.alpha / scale, p.k, p.c};
}

/// 1 - alpha c P_s/a: must be positive, else the reversible part runs away by itself at zero field.
template <class T>
T reversible_margin(const Params<T>& p) {
  return T{1} - p.alpha * p.c * p.p_s / p.a;
}

}  // namespace hysteron::jiles_atherton
