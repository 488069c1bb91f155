// Decides what the effects of a block whose output moves (a mass, a tank) take for its travel.
#pragma once

#include <string>

#include "discover/hypotheses/effect.h"

namespace hysteron::effects {

/// How far the block's output moved [SI].
inline double travelled(const Excitation& at) { return at.travel_highest - at.travel_lowest; }

/// A number [SI] of the block that is varied; `otherwise` where it has none of this name.
inline double own_number(const Excitation& at, const char* name, double otherwise) {
  const auto found = at.own.find(name);
  return found == at.own.end() ? otherwise : found->second;
}

/// Of a motor that a voltage drives, the torque of a volt while it stands [N m/V]; 0 = it is none.
inline double torque_of_a_volt(const Excitation& at) {
  if (at.unit.dimension != parse_unit("V").dimension) return 0;
  return own_number(at, "torque_constant", 0) / own_number(at, "resistance", 1);
}

/// The block is an integrator that makes a speed of the acceleration on its wire.
inline bool makes_a_speed(const Excitation& at) { return at.by == "integrator_with_friction"; }

/// A torque drives the block, or a voltage that makes one, or an acceleration of an angle: what it drives turns, and is
/// an inertia.
inline bool turns(const Excitation& at) {
  if (makes_a_speed(at)) return at.unit.dimension == parse_unit("rad/s^2").dimension;
  return at.unit.dimension == parse_unit("N m").dimension || torque_of_a_volt(at) > 0;
}

/// Range of the force [N] or torque [N m] that drives the block; of a motor, as if it stood; of an integrator, of the
/// acceleration.
inline double driving_range(const Excitation& at) {
  const double of_a_volt = torque_of_a_volt(at);
  return of_a_volt > 0 ? of_a_volt * at.range() : at.range();
}

/// [m], [rad] that a mass or an inertia moves; a micrometre where nobody looked.
inline double travel(const Excitation& at) { return travelled(at) > 0 ? travelled(at) : 1e-6; }

/// Why the effects of what moves ("the mass") cannot be seen in these recordings; "" where they can.
inline std::string stands(const Excitation& at, const char* what) {
  return at.from_data && !(travelled(at) > 0) ? std::string(what) + " does not move" : "";
}

}  // namespace hysteron::effects
