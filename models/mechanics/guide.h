// Decides how much a guide with friction holds back of a motion that has no mass of its own: an actuator, stiff beside
// what it drives, in a guideway. Does not decide what moves it.
#pragma once

#include <cmath>

#include "models/mechanics/presliding.h"

namespace hysteron::guide {

/// Units for a motion in m; any other works alike.
template <class T>
struct Params {
  T level{0};              ///< [m]    what the friction of fast sliding holds back, >= 0
  T slip_distance{1};      ///< [m]    way from sticking to sliding, > 0
  T excess{0};             ///< [-]    by how much more it holds before it slides fast, F_s/F_c - 1
  T stribeck_velocity{1};  ///< [m/s]  speed of the free motion at which the excess is gone, > 0 where there is one
};

/// What it holds at most at a speed of the free motion, over what it holds while it slides fast. The speed is that of
/// the free motion: the two agree while it slides, and with its own speed a guide without mass would jump where the
/// friction falls.
template <class T>
T sliding_level(const Params<T>& p, const T& free_speed) {
  return p.excess > T{0} ? presliding::stribeck_level(p.excess, p.stribeck_velocity, free_speed) : T{1};
}

/// Rate [1/s] of the share s that it holds of `level`, for a rate v [m/s] of the free motion u; the motion is
/// y = u - level s.
///
///   ds/dt = (y' - |y'| s/g)/slip_distance,  y' = v - level ds/dt,  g = sliding_level
///
/// Dahl's element along the way of the motion itself, solved for its rate: along u with k = (1 - s/g)/slip_distance in
/// the direction of v, ds/dt = v k/(1 + level k). Rate independent for excess 0, and where the motion is fast beside
/// the Stribeck velocity. Needs level k > -1: see may_jump. Source: Dahl, AIAA J. 14 (1976) 1675-1682; Stribeck's
/// curve: presliding::stribeck_level.
template <class T>
T share_rate(const Params<T>& p, const T& share, const T& free_speed) {
  const T g = sliding_level(p, free_speed);
  const double side = free_speed < T{0} ? -1 : 1;
  const T k = (1.0 - side * share / g) / p.slip_distance;
  return free_speed * k / (1.0 + p.level * k);
}

/// True if a guide so sticky jumps when it breaks away: its friction falls by more than the motion gives way.
inline bool may_jump(const Params<double>& p) { return p.level * p.excess >= p.slip_distance; }

/// The share behind a free way [m] that took h [s], in one direction at one speed: share_rate solved along the way y of
/// the motion, s = side g + (share - side g) exp(-|y|/(g slip_distance)), with y + level (s - share) = free_way.
/// By Newton's method from the side on which it never steps beyond the root.
inline double share_after(const Params<double>& p, double share, double free_way, double h) {
  if (free_way == 0) return share;
  const double g = sliding_level(p, p.excess > 0 ? free_way / h : 0.0);
  const double side = std::copysign(1.0, free_way), left = side * g - share;  // until it slides
  const double distance = g * p.slip_distance, grows = side * p.level * left, wanted = std::fabs(free_way);
  // f(y) = y + grows (1 - exp(-y/distance)) - wanted: concave from y = 0 for grows > 0, convex from its end otherwise.
  double y = grows > 0 ? 0 : wanted - grows;
  for (int i = 0; i < 60; ++i) {
    const double decay = std::exp(-y / distance);
    const double step = (wanted - y - grows * (1 - decay)) / (1 + grows / distance * decay);
    y += step;
    if (!(std::fabs(step) > 1e-15 * wanted)) break;
  }
  return share - left * std::expm1(-y / distance);
}

}  // namespace hysteron::guide
