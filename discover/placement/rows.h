// Decides how signals of a program are simulated at given times, for questions that are no fit. Internal to discover.
#pragma once

#include <vector>

#include "engine/program/program.h"

namespace hysteron {

/// Values [signal][row] at times `t`, the inputs of the diagram bound to `inputs` (as Program::input_names).
/// Throws Error where the simulation fails.
std::vector<std::vector<double>> simulate_rows(const ProgramPointer& program, const std::vector<SeriesPointer>& inputs,
                                               const std::vector<double>& t, const std::vector<int>& signals,
                                               bool at_rest);

}  // namespace hysteron
