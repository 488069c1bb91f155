// Decides what the effects of a block whose output moves (a mass, a tank) take for its travel.
#pragma once

#include <string>

#include "discover/effect.h"

namespace hysteron::effects {

/// [m] that the mass moves; a micrometre where nobody looked.
inline double travel(const Circumstances& at) {
  const double range = at.travel_highest - at.travel_lowest;
  return range > 0 ? range : 1e-6;
}

/// Of a tank: how far its level moved.
inline double travelled(const Circumstances& at) { return at.travel_highest - at.travel_lowest; }

inline std::string level_stands(const Circumstances& at) {
  return at.from_data && !(travelled(at) > 0) ? "the level does not move" : "";
}

}  // namespace hysteron::effects
