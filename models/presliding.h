// Decides the deflection of elements that stick like springs and slip after a distance (Dahl): friction before sliding,
// and the hysteresis of a spring. Does not decide what they act on.
#pragma once

#include <cmath>

namespace hysteron::presliding {

/// Rate of an element's deflection z [m/s]: dz/dt = v - |v| z/distance. v [m/s] velocity, distance [m] > 0 after which
/// it slips; its force is stiffness z, at most stiffness distance. Rate independent; |z| stays below the distance.
/// Source: Dahl, AIAA J. 14 (1976) 1675-1682, exponent 1, force over stiffness.
template <class T>
T deflection_rate(const T& distance, const T& z, const T& velocity) {
  using std::abs;
  return velocity - abs(velocity) * z / distance;
}

/// The same for an element that yields at its distance and is elastic on the way back (Maxwell's slip with a rounded
/// corner): dz/dt = v (1 - (z/distance)^4) while the motion loads it, v while it unloads. With sharp corners elements
/// of several distances in parallel are a spring whose loops close at their turning points, as plays do (Masing's
/// rules), and so nearly do these; Dahl's do not. A higher exponent is a sharper corner, and stiffer to integrate.
/// Source: Iwan, J. Appl. Mech. 33 (1966) 893-900; transition as in Bouc-Wen's law with beta = gamma, n = 4.
template <class T>
T slip_rate(const T& distance, const T& z, const T& velocity) {
  if (!(z * velocity > 0)) return velocity;
  const T part = z / distance * (z / distance);
  return velocity * (1.0 - part * part);
}

/// How much more the element holds before it slides fast: 1 + e exp(-(v/v_s)^2); its slip distance is as much longer.
/// e = F_s/F_c - 1, v_s [m/s] > 0. Source: Canudas de Wit, Olsson, Astrom, Lischinsky, IEEE Trans. Autom. Control 40
/// (1995) 419-425.
template <class T>
T stribeck_level(const T& excess, const T& stribeck_velocity, const T& velocity) {
  using std::exp;
  const T ratio = velocity / stribeck_velocity;
  return 1.0 + excess * exp(-(ratio * ratio));
}

/// Rate [1/s] of the share s = z/distance of its largest force that an element holds which yields below sliding too:
/// ds/dt = (v - sqrt(v^2 + v_c^2) s)/distance. At a steady velocity s = v/sqrt(v^2 + v_c^2): the curve of a fluid that
/// flows before it yields, and Dahl's element for a crossover v_c = 0. |s| <= 1.
/// v [m/s], distance [m] > 0, v_c [m/s] >= 0.
/// Source: Dahl (as above), with Maxwell's relaxation at rest, time distance/v_c; curve of a damper with a yield force:
/// Spencer, Dyke, Sain, Carlson, J. Eng. Mech. 123 (1997) 230-238.
template <class T>
T yield_rate(const T& distance, const T& crossover, const T& share, const T& velocity) {
  using std::abs;
  using std::sqrt;
  const T speed = crossover > 0.0 ? T(sqrt(velocity * velocity + crossover * crossover)) : T(abs(velocity));
  return (velocity - speed * share) / distance;
}

/// The share [-] at which it settles at a steady velocity [m/s].
inline double sliding_share(double crossover, double velocity) {
  const double speed = std::hypot(velocity, crossover);
  return speed > 0 ? velocity / speed : 0;
}

/// Deflection [m] after a steady motion by x [m] from z = 0 in one direction: distance (1 - exp(-|x|/distance))
/// sign(x).
inline double deflection_after(double distance, double x) {
  return std::copysign(distance * -std::expm1(-std::fabs(x) / distance), x);
}

}  // namespace hysteron::presliding
