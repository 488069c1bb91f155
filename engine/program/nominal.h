// Decides how large each signal and state typically is, and how fast the sources move: for tolerances and thresholds
// only. A wrong guess costs accuracy near zero or steps, never correctness.
#pragma once

#include <vector>

#include "engine/program/program.h"

namespace hysteron {

inline constexpr double usual_length = 1e-6;  ///< [m] where nothing is known: actuators move micrometres
inline constexpr double usual_size = 1;       ///< [SI] anything else

struct NominalSizes {
  std::vector<double> signals;  ///< [SI]; 0 = unknown
  std::vector<double> states;   ///< [SI], always > 0
  double time_scale = 0;        ///< [s] amplitude over rate of the fastest source; 0 = no source moves smoothly
};

NominalSizes nominal_sizes(const Program& program, const Run& run);

/// Nominal size of each state [SI], from declarations and the sizes of the sources, for absolute tolerances.
std::vector<double> nominal_states(const Program& program, const Run& run);

}  // namespace hysteron
