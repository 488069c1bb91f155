// Decides how a program is advanced with steps whose length follows the error, by the integrators, from event to event.
#pragma once

#include <vector>

#include "engine/simulate/simulate.h"

namespace hysteron {

/// `options`: the method is bdf, adams or runge_kutta, and the tolerance that of each step (step_tolerances.h).
/// Throws Error "diverged", "step_too_small" or "solver_failed" naming block, time and states where it fails.
Traces simulate_in_adaptive_steps(const Program& program, Run run, SimulateOptions options,
                                  std::vector<double> instants, std::vector<int> signals);

}  // namespace hysteron
