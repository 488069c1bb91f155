// Decides when a simulation is handed to the exact advance (advance.h), and how finely it cuts the rows there. Internal
// to the ways of simulating.
#pragma once

#include <optional>
#include <vector>

#include "engine/simulate/simulate.h"

namespace hysteron {

/// True if the method and the diagram allow it; "auto" does not take it for loops with nonlinear blocks. Throws Error
/// "not_exact" where it was asked for and cannot be.
bool advances_exactly(const Program& program, const SimulateOptions& options);
/// Nothing where the method may be another and no number of substeps that pays gives the tolerance; else `instants` are
/// moved into the answer.
std::optional<Traces> simulate_exactly(const Program& program, const Run& run, const SimulateOptions& options,
                                       std::vector<double>& instants, const std::vector<int>& signals);

}  // namespace hysteron
