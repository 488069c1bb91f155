// Decides at which times a simulation gives outputs. Internal to the ways of simulating.
#pragma once

#include <vector>

#include "engine/simulate/simulate.h"

namespace hysteron {

/// The output times: as given, or begin, begin + every ... until. Throws Error "bad_value" for options that make no
/// sense.
std::vector<double> output_instants(const SimulateOptions& options);

}  // namespace hysteron
