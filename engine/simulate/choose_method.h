// Decides which integrator the method "auto" takes where the exact advance does not apply. Backward differences build
// up their order again behind every restart, which an explicit Runge-Kutta formula need not; but its steps may not be
// much longer than the fastest decay, which theirs may. Does not integrate.
#pragma once

#include <string>

#include "engine/simulate/simulate.h"

namespace hysteron {

struct MethodChoice {
  Method method = Method::bdf;
  std::string why;  ///< "held signals jump every 0.1 ms, and ...": what made the choice
};

/// Largest |eigenvalue| of d(dx/dt)/dx for the states of `run` at `begin` [1/s]; not a number where there is none: no
/// state, more than 100, inputs that are not bound, no slopes there.
double fastest_rate(const Program& program, const Run& run, double begin);

/// For a run that starts at `begin` and lasts `span` [s]: runge_kutta where held signals (of sampled blocks, or of
/// recordings that are held between their samples) jump often into continuous states and the fastest eigenvalue of the
/// Jacobian at the start leaves few explicit steps between two jumps; else bdf. Inputs must be bound, else bdf.
MethodChoice choose_method(const Program& program, const Run& run, double begin, double span);

}  // namespace hysteron
