// Decides to which error each step is held, so that the result has the one asked for. Internal to simulate.
#pragma once

#include <vector>

#include "engine/program/nominal.h"
#include "engine/simulate/simulate.h"

namespace hysteron {

/// The options as the integrators get them; the absolute tolerance is a multiple of the relative one.
SimulateOptions held_tolerance(const Program& program, SimulateOptions options);

/// Absolute tolerance per state [SI]; never empty.
std::vector<double> absolute_tolerances(const NominalSizes& sizes, const SimulateOptions& options);

}  // namespace hysteron
