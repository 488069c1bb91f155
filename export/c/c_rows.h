// Decides what the engine says to given inputs, step by step: what the code is held against, and how far the sampled
// form of a diagram is from the diagram itself. Does not write text.
#pragma once

#include <vector>

#include "export/c/c_plan.h"

namespace hysteron {

using SignalRows = std::vector<std::vector<double>>;  ///< [signal][row], SI

/// Times of `count` steps of `period` [s] from 0 on, as the clocks of the engine count them.
std::vector<double> step_times(double period, std::size_t count);

/// Outputs of a program without continuous states at these times, its inputs straight between them: its blocks' own
/// functions, one evaluation per step.
SignalRows stepped_outputs(const Program& program, const std::vector<double>& times, const SignalRows& inputs);

/// The same of any program, its continuous states integrated to a relative 1e-9.
SignalRows continuous_outputs(const Program& program, const std::vector<double>& times, const SignalRows& inputs);

/// Where nothing says what goes in: slow and fast turns that shrink and grow, from 0 to `size` [SI]. The same numbers
/// for the same `which`.
std::vector<double> tried_input(double size, std::size_t which, std::size_t count);

}  // namespace hysteron
