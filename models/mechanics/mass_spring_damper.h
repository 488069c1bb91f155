// Decides the motion of one mass on a spring, linear or stiffening, with a damper and the drag of a fluid. Does not
// decide friction (friction.h) nor stops (hard_stop.h).
#pragma once

#include <algorithm>
#include <cmath>

namespace hysteron::mass_spring_damper {

template <class T>
struct Params {
  T mass{1};        ///< [kg]
  T damping{0};     ///< [N s/m]
  T stiffness{1};   ///< [N/m]
  T stiffening{0};  ///< [N/m^3]  cubic part of the spring; negative = softening
  T quadratic{0};   ///< [N/m^2]  part by which it is harder one way than the other
  T quintic{0};     ///< [N/m^5]  part of large travel
  T drag{0};        ///< [N s^2/m^2]  of a fast flow: rho A C_d/2
};

/// k x + k_2 x^2 + k_3 x^3 + k_5 x^5 [N]. Source: Duffing's oscillator; Nayfeh, Mook, Nonlinear Oscillations (1979).
template <class T>
T spring(const Params<T>& p, const T& x) {
  const T square = x * x;
  return x * (p.stiffness + p.quadratic * x + square * (p.stiffening + p.quintic * square));
}
/// Its slope [N/m].
template <class T>
T slope(const Params<T>& p, const T& x) {
  const T square = x * x;
  return p.stiffness + 2.0 * p.quadratic * x + square * (3.0 * p.stiffening + 5.0 * p.quintic * square);
}

/// Drag c_2 v |v| [N] of a fast flow; c_2 [N s^2/m^2] = rho A C_d/2. Source: Batchelor, An Introduction to Fluid
/// Dynamics (1967), section 5.11.
template <class T>
T drag(const T& coefficient, const T& velocity) {
  using std::abs;
  return coefficient * velocity * abs(velocity);
}

/// dv/dt: m v' = F - d v - drag - spring(x) [m/s^2]; dx/dt = v.
template <class T>
T acceleration(const Params<T>& p, const T& position, const T& velocity, const T& force) {
  return (force - p.damping * velocity - drag(p.drag, velocity) - spring(p, position)) / p.mass;
}

/// Position [m] at which the spring balances the force: Newton from the linear spring's answer, kept in the bracket
/// 0 ... F/k of a stiffening spring. Not a number where there is none (no spring, or softer than the force needs).
inline double rest(const Params<double>& p, double force) {
  double x = force / p.stiffness;
  const bool bent = p.quadratic != 0 || p.quintic != 0;
  if (p.stiffening == 0 && !bent) return force == 0 && p.stiffness == 0 ? 0.0 : std::isfinite(x) ? x : std::nan("");
  if (p.stiffness == 0 && !bent) return p.stiffening > 0 ? std::cbrt(force / p.stiffening) : std::nan("");
  if (p.stiffening > 0 && p.stiffness > 0)  // below both the linear and the purely cubic spring's answer
    x = std::copysign(std::min(std::fabs(x), std::cbrt(std::fabs(force) / p.stiffening)), force);
  for (int i = 0; i < 60; ++i) {
    const double rise = slope(p, x);
    if (!(rise > 0)) return std::nan("");
    const double move = (force - spring(p, x)) / rise;
    x += move;
    if (std::fabs(move) <= 1e-15 * std::fabs(x)) return x;
  }
  return std::fabs(spring(p, x) - force) <= 1e-12 * std::fabs(force) ? x : std::nan("");
}

/// Undamped frequency of small motions about x = 0 [Hz].
template <class T>
T natural_frequency(const Params<T>& p) {
  using std::sqrt;
  return sqrt(T{p.stiffness / p.mass}) / T{6.283185307179586476925287};
}

}  // namespace hysteron::mass_spring_damper
