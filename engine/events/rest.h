// Decides where a run is at rest: the equilibrium of its states for inputs that stay as they are.
#pragma once

#include "engine/program/program.h"

namespace hysteron {

/// Sets the states to the equilibrium for constant inputs as they are at time t: dx/dt = 0 with the memory as
/// committed. States that have no equilibrium of their own (an integrator with zero input) stay as they are. Throws
/// Error(Fault::numerics) "no_rest" if there is none.
void settle_at_rest(const Program& program, Run& run, double t);

}  // namespace hysteron
