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

/// Deflection [m] after a steady motion by x [m] from z = 0 in one direction: distance (1 - exp(-|x|/distance))
/// sign(x).
inline double deflection_after(double distance, double x) {
  return std::copysign(distance * -std::expm1(-std::fabs(x) / distance), x);
}

}  // namespace hysteron::presliding
