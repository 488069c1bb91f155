// Decides what the effects of a block whose output moves (a mass, a tank) take for its travel.
#pragma once

#include <string>

#include "discover/hypotheses/effect.h"

namespace hysteron::effects {

/// How far the block's output moved [SI].
inline double travelled(const Excitation& at) { return at.travel_highest - at.travel_lowest; }

/// A torque stands on the wire: what it drives turns, and is an inertia.
inline bool turns(const Excitation& at) { return at.unit.dimension == parse_unit("N m").dimension; }

/// [m], [rad] that a mass or an inertia moves; a micrometre where nobody looked.
inline double travel(const Excitation& at) { return travelled(at) > 0 ? travelled(at) : 1e-6; }

/// Why the effects of what moves ("the mass") cannot be seen in these recordings; "" where they can.
inline std::string stands(const Excitation& at, const char* what) {
  return at.from_data && !(travelled(at) > 0) ? std::string(what) + " does not move" : "";
}

}  // namespace hysteron::effects
