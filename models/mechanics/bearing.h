// Decides dry friction beside a damping: the speed at which the damping alone would brake as much as both do. Does not
// decide what it brakes.
#pragma once

#include "models/mechanics/presliding.h"

namespace hysteron::bearing {

/// Units for m/s; any other speed works alike.
template <class T>
struct Params {
  T level{0};              ///< [m/s]  dry friction of fast sliding over the damping, F_c/b, >= 0
  T slip_distance{1};      ///< [m]    way from sticking to sliding, > 0
  T excess{0};             ///< [-]    by how much more it holds at low speed, F_s/F_c - 1
  T stribeck_velocity{0};  ///< [m/s]  at which the excess is gone; 0 = it has none
};

/// Rate [1/s] of the share s of the friction that the contact holds at a speed v [m/s]: Dahl's element,
/// ds/dt = (v - |v| s)/slip_distance, |s| <= 1.
template <class T>
T share_rate(const Params<T>& p, const T& share, const T& speed) {
  return presliding::yield_rate(p.slip_distance, T(0.0), share, speed);
}

/// v + level (1 + excess exp(-(v/stribeck_velocity)^2)) s [m/s]: times the damping b it is b v + F_c sgn(v) while it
/// slides, and Stribeck's curve with an excess.
/// Source: Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083-1138 (Gaussian curve); Dahl, AIAA J.
/// 14 (1976) 1675-1682 (sticking).
template <class T>
T braking_speed(const Params<T>& p, const T& share, const T& speed) {
  if (!(p.stribeck_velocity > 0.0)) return speed + p.level * share;
  return speed + p.level * presliding::stribeck_level(p.excess, p.stribeck_velocity, speed) * share;
}

/// The share behind h [s] in which the speed goes straight from one to the other: share_rate solved along the way, out
/// and back where the speed turns. However short the slip distance is beside the way.
inline double share_after(const Params<double>& p, double share, double from, double to, double h) {
  presliding::SlippingElement contact(p.slip_distance, share * p.slip_distance);
  if (from * to < 0) {
    const double turn = h * from / (from - to);
    contact.move(0.5 * from * turn);
    contact.move(0.5 * to * (h - turn));
  } else {
    contact.move(0.5 * (from + to) * h);
  }
  return contact.z() / p.slip_distance;
}

}  // namespace hysteron::bearing
