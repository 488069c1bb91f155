// Decides how a program is advanced with steps of one length, as a controller in real time would: explicit Euler or the
// classical Runge-Kutta formula of order four. No error control: the step is the user's answer to the question of
// accuracy.
#pragma once

#include <vector>

#include "engine/simulate/simulate.h"

namespace hysteron {

inline bool has_fixed_steps(Method method) { return method == Method::euler || method == Method::rk4; }

/// Throws Error "bad_value" where options.step is none to go from options.begin to `end` [s] with: not positive, longer
/// than the run, so short that the run would not end, or nearer than times there can be told apart.
void check_step(const SimulateOptions& options, double end);

/// Steps end at begin + k options.step, and besides at corners of the sources and at sampling instants, so that no step
/// runs across one; guards are looked at where steps end. Between steps outputs are interpolated (cubic, Hermite).
/// Throws Error "bad_value" as check_step does, "diverged" where a value is not finite. Warns where the fastest time
/// constant at the start is too short for the step.
Traces simulate_in_fixed_steps(const Program& program, Run run, const SimulateOptions& options,
                               std::vector<double> instants, const std::vector<int>& signals);

}  // namespace hysteron
