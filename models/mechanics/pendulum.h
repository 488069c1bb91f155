// Decides the motion of a pendulum: a mass on an arm under gravity. Does not move its pivot.
#pragma once

#include <cmath>

namespace hysteron::pendulum {

template <class T>
struct Params {
  T mass{1};           ///< [kg]
  T length{1};         ///< [m] from the pivot to the centre of mass
  T inertia{0};        ///< [kg m^2] about the centre of mass; 0: a point
  T damping{0};        ///< [N m s/rad]
  T gravity{9.80665};  ///< [m/s^2]
};

/// (J + m l^2) theta'' = torque - d theta' - m g l sin(theta), theta [rad] from where it hangs [rad/s^2].
/// Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd ed. (2002), chapter 5 (parallel axes).
template <class T>
T acceleration(const Params<T>& p, const T& angle, const T& speed, const T& torque) {
  using std::sin;
  return (torque - p.damping * speed - p.mass * p.gravity * p.length * sin(angle)) /
         (p.inertia + p.mass * p.length * p.length);
}

/// Angle [rad] in equilibrium under a constant torque; not a number where that turns it over.
inline double rest(const Params<double>& p, double torque) {
  return std::asin(torque / (p.mass * p.gravity * p.length));
}

}  // namespace hysteron::pendulum
