// Decides the compensator of a Bouc-Wen actuator: the command whose displacement is the wanted one, with its algebraic
// loop among the rates solved. Does not decide the actuator's law: bouc_wen.h.
#pragma once

#include <cmath>
#include <limits>

#include "models/hysteresis/bouc_wen.h"
#include "models/number.h"
#include "models/path.h"

namespace hysteron::bouc_wen {

/// Command for the wanted displacement r and the hysteretic part z: u = (r + z)/d_p. Source: thesis Eq. 2.38.
template <class T>
T command(const Params<T>& p, const T& wanted, const T& z) {
  return (wanted + z) / p.d_p;
}

/// Slope dr/du of the actuator at z, on the branch with rising (direction = 1) or falling (-1) command:
///
///   d_p - alpha + (beta d z + gamma |z|) |z/scale|^(n-1)
///
/// Must be of the sign of d_p for the compensator to exist.
template <class T>
T displacement_slope(const Params<T>& p, const T& z, int direction) {
  using std::abs;
  using std::pow;
  const T bend = p.beta * T(direction) * z + p.gamma * abs(z);
  if (p.exponent == 1) return p.d_p - p.alpha + bend;
  return p.d_p - p.alpha + bend * pow(T{abs(z) / T{p.scale} + T{bouc_wen::least_size}}, p.exponent - 1);
}

/// Rate of the hysteretic part of the compensator for the rate of the wanted displacement: u = (r + z)/d_p with z
/// driven by u is a loop du/dt <-> dz/dt; solved for du/dt = (dr/dt)/displacement_slope, then the law of z.
/// Rate independent; not a number where the compensator does not exist. Source: thesis Fig. 2.8, Eq. 2.38 in its solved
/// form; Rakotondrabe, IEEE Trans. Autom. Sci. Eng. 8 (2011) 428-431.
template <class T>
T compensator_rate(const Params<T>& p, const T& z, const T& wanted_rate) {
  const T slope = displacement_slope(p, z, wanted_rate < T{0} ? -1 : 1);
  const bool exists = plain(slope) * plain(p.d_p) > 0;
  return z_rate(p, z, exists ? T{wanted_rate / slope} : T{std::numeric_limits<double>::quiet_NaN()});
}

/// z after a straight move of the wanted displacement by `move`. Not a number where the compensator does not exist.
template <class T>
T compensator_after(const Params<T>& p, const T& z, const T& move, double relative = path::tolerance) {
  return path::follow([&](double, const T& at) { return compensator_rate(p, at, move); }, z, relative);
}

/// z after a straight move of the actuator's input by `move`.
template <class T>
T z_after(const Params<T>& p, const T& z, const T& move, double relative = path::tolerance) {
  return path::follow([&](double, const T& at) { return z_rate(p, at, move); }, z, relative);
}

}  // namespace hysteron::bouc_wen
