// Decides a mass on a spring between two hard stops: free or lying at a stop, and what an impact does.
// Does not locate the impacts. There are two free modes that take turns: an impact is a change of mode too.
#pragma once

#include <algorithm>

namespace hysteron::hard_stop {

enum Mode { free, free_again, at_lower, at_upper };

template <class T>
struct Params {
  T mass{1};         ///< [kg]
  T damping{0};      ///< [N s/m]
  T stiffness{0};    ///< [N/m]
  T lower{-1};       ///< [m]  lower < upper
  T upper{1};        ///< [m]
  T restitution{0};  ///< [-]  speed after over speed before an impact, 0 ... 1
  T rest_speed{0};   ///< [m/s] a slower rebound is none: ends the infinite series of ever smaller ones
};

/// How far a mass enters a stop before it counts as an impact [m]: an event may then begin exactly at a stop.
inline constexpr double depth = 1e-12;

/// Mode and motion behind an event.
template <class T>
struct Landing {
  Mode mode = free;
  T position{};
  T velocity{};
};

/// F - k x - d v [N].
template <class T>
T pull(const Params<T>& p, const T& position, const T& velocity, const T& force) {
  return force - p.stiffness * position - p.damping * velocity;
}

/// dv/dt: m v' = F - k x - d v where free, 0 at a stop (where v = 0). [m/s^2]
template <class T>
T acceleration(const Params<T>& p, Mode mode, const T& position, const T& velocity, const T& force) {
  if (mode == at_lower || mode == at_upper) return T{0};
  return pull(p, position, velocity, force) / p.mass;
}

/// Positive = the mode may stay: room to the nearer stop [m] where free, force into the stop [N] at a stop.
template <class T>
T guard(const Params<T>& p, Mode mode, const T& position, const T& force) {
  using std::min;
  if (mode == at_upper) return pull(p, p.upper, T{0}, force);
  if (mode == at_lower) return -pull(p, p.lower, T{0}, force);
  return min(T{position - p.lower}, T{p.upper - position}) + T{depth};
}

/// What follows a mode whose guard is not positive, never the mode itself. At a stop: free, from rest. Free: an impact
/// at speed w rebounds with e w, unless that is not above rest_speed; then the mass lies at the stop if the force
/// presses, else it is free from rest. Source: Newton's law of restitution; Brogliato, Nonsmooth Mechanics, 3rd ed.
/// (2016).
template <class T>
Landing<T> land(const Params<T>& p, Mode mode, const T& position, const T& velocity, const T& force) {
  if (mode == at_lower) return {free, p.lower, T{0}};
  if (mode == at_upper) return {free, p.upper, T{0}};
  const bool up = p.upper - position < position - p.lower;
  const T stop = up ? p.upper : p.lower;
  const T back = p.restitution * (up ? velocity : T{-velocity});
  const Mode other = mode == free ? free_again : free;
  if (back > p.rest_speed) return {other, stop, up ? T{-back} : back};
  const T held = pull(p, stop, T{0}, force);
  const bool pressed = up ? held > T{0} : held < T{0};
  return {pressed ? (up ? at_upper : at_lower) : other, stop, T{0}};
}

}  // namespace hysteron::hard_stop
