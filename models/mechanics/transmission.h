// Decides what an elastic transmission does between two moving sides: a gear, a belt, a screw, with play, compliance,
// damping and losses. Does not decide the motion of the sides.
#pragma once

#include <algorithm>
#include <cmath>

namespace hysteron::transmission {

/// How much it gives: units of a gear, whose driven side turns.
template <class T>
struct Contact {
  T stiffness{1};  ///< [N m/rad]
  T damping{0};    ///< [N m s/rad]  while the sides touch
  T gap{0};        ///< [rad]        total play; 0 = none
};

/// Load on the driven side [N m] where the driver is ahead by `twist` [rad] and pulls ahead with `rate` [rad/s]:
/// stiffness times what the twist is beyond half of the gap, and the damping while the sides touch, which do not stick
/// together: it never pulls. Without a gap it pulls and pushes.
/// Source: Nordin, Gutman, Automatica 38 (2002) 1633-1649, Eqs. 1 and 2 (dead zone with damping within contact).
template <class T>
T load(const Contact<T>& c, const T& twist, const T& rate) {
  using std::max;
  using std::min;
  if (!(c.gap > T{0})) return c.stiffness * twist + c.damping * rate;
  const T half = T{0.5} * c.gap;
  if (twist > half) return max(T{0}, T{c.stiffness * (twist - half) + c.damping * rate});
  if (twist < -half) return min(T{0}, T{c.stiffness * (twist + half) + c.damping * rate});
  return T{0};
}

/// Over which speed of the driver a loss turns its sign [rad/s]: at rest a loss has none.
inline constexpr double turning_speed = 0.01;

/// What the driver feels [N m] of a `load` on the driven side that it moves by 1/ratio [N m]: what it gives to it over
/// the efficiency where it drives, times the efficiency where it is driven, with a tanh over `turning_speed` between.
/// 0 < efficiency <= 1. Source: Niemann, Winter, Maschinenelemente 2, 2nd ed. (2003), section 21.6.
template <class T>
T felt(const T& load, const T& ratio, const T& efficiency, const T& speed) {
  using std::abs;
  using std::tanh;
  const T mean = T{0.5} * (T{1} / efficiency + efficiency), half = T{0.5} * (T{1} / efficiency - efficiency);
  const T through = load / ratio;
  return through * mean + abs(through) * half * tanh(T{speed / T{turning_speed}});
}

}  // namespace hysteron::transmission
