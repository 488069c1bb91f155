// Decides a mass with dry friction that truly sticks: three modes, their motion, when each may stay, what follows.
// Does not locate the transitions and knows no presliding.
#pragma once

#include <cmath>
#include <type_traits>

#include "models/mechanics/mass_spring_damper.h"

namespace hysteron::friction {

enum Mode { stick, slide_up, slide_down };

template <class T>
struct Params {
  T mass{1};               ///< [kg]
  T damping{0};            ///< [N s/m]  viscous
  T stiffness{0};          ///< [N/m]    spring to the ground
  T coulomb{0};            ///< [N]      dry friction of fast sliding
  T breakaway{0};          ///< [N]      force at which sticking ends, at least coulomb
  T stribeck_velocity{0};  ///< [m/s]    over which breakaway falls to coulomb; 0 = at once
  T rest_speed{1e-9};      ///< [m/s]    a slower motion against the sliding direction counts as none; positive
  T stiffening{0}, quadratic{0}, quintic{0}, drag{0};  ///< as in mass_spring_damper::Params
  T falls_by{2};  ///< [-] d: how breakaway falls, 2 = Gauss's bell, 1 = an exponential; positive
};

/// The mass without its dry friction.
template <class T>
mass_spring_damper::Params<T> body(const Params<T>& p) {
  return {p.mass, p.damping, p.stiffness, p.stiffening, p.quadratic, p.quintic, p.drag};
}

/// Dry friction while sliding: F_c + (F_b - F_c) exp(-|v/v_s|^d) [N], without its sign.
/// Source: Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083-1138; d = 1: Tustin, J. IEE 94 (1947)
/// 143-151; others: Bo, Pavelescu, Wear 82 (1982) 277-289.
template <class T>
T sliding_force(const Params<T>& p, const T& velocity) {
  using std::abs;
  using std::exp;
  using std::pow;
  if (!(p.stribeck_velocity > T{0})) return p.coulomb;
  const T ratio = velocity / p.stribeck_velocity, more = p.breakaway - p.coulomb;
  if constexpr (std::is_same_v<T, double>) {  // what carries slopes carries that of the exponent, too
    if (p.falls_by == 2) return p.coulomb + more * exp(-(ratio * ratio));
    if (p.falls_by == 1) return p.coulomb + more * exp(-abs(ratio));
  }
  if (!(abs(ratio) > T{0})) return p.breakaway;
  return p.coulomb + more * exp(-pow(T(abs(ratio)), p.falls_by));
}

/// Nothing to stick to: the mass slides for ever, whichever way, and no turn of its motion is an event.
template <class T>
bool is_absent(const Params<T>& p) {
  return !(p.coulomb > T{0}) && !(p.breakaway > T{0});
}

/// In each mode the acceleration is a sum of multiples of position, velocity and force, and a constant. False where a
/// number that decides is NaN.
template <class T>
bool is_affine_in_modes(const Params<T>& p) {
  const bool falls = !(p.stribeck_velocity == T{0}) && !(p.breakaway == p.coulomb);
  return !falls && p.stiffening == T{0} && p.quadratic == T{0} && p.quintic == T{0} && p.drag == T{0};
}

/// Force on a mass at rest, before friction: F - spring(x) [N].
template <class T>
T pull(const Params<T>& p, const T& position, const T& force) {
  return force - mass_spring_damper::spring(body(p), position);
}

/// dv/dt: m v' = F - spring(x) - d v - drag -/+ sliding_force on slide_up/slide_down, 0 while it sticks (where v = 0).
/// [m/s^2]
template <class T>
T acceleration(const Params<T>& p, Mode mode, const T& position, const T& velocity, const T& force) {
  if (mode == stick) return T{0};
  const T dry = sliding_force(p, velocity);
  const bool up = is_absent(p) ? !(velocity < T{0}) : mode == slide_up;  // zero, but its slopes have a sign
  return mass_spring_damper::acceleration(body(p), position, velocity, T(force - (up ? dry : T{-dry})));
}

/// Positive = the mode may stay: reserve of the holding force [N] while it sticks, speed [m/s] while it slides. Sliding
/// ends a little behind v = 0, so that it may begin at v = 0.
template <class T>
T guard(const Params<T>& p, Mode mode, const T& position, const T& velocity, const T& force) {
  using std::abs;
  if (mode == stick) return p.breakaway - abs(pull(p, position, force));
  if (is_absent(p)) return T{1};
  return (mode == slide_up ? velocity : T{-velocity}) + p.rest_speed;
}

/// What follows a mode whose guard is not positive, never the mode itself; the velocity is then zero. A mass that stuck
/// slides where it is pulled; one that slid turns where the pull reaches the breakaway force, else it sticks.
template <class T>
Mode next(const Params<T>& p, Mode mode, const T& position, const T& force) {
  const T f = pull(p, position, force);
  if (mode == stick) return f < T{0} ? slide_down : slide_up;
  if (mode == slide_up) return f <= -p.breakaway ? slide_down : stick;
  return f >= p.breakaway ? slide_up : stick;
}

/// Mode to begin with at a velocity; whether a resting mass sticks is then for guard and next to say.
template <class T>
Mode start(const T& velocity) {
  return velocity > T{0} ? slide_up : velocity < T{0} ? slide_down : stick;
}

}  // namespace hysteron::friction
