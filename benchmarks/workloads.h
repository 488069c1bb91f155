// Decides which workloads are timed and what each reports. The reporter in main.cpp turns the times into ratios.
#pragma once

#include <vector>

namespace hysteron::benchmarks {

/// Registers "closed loop/..." (WORKLOADS W1) and "open loop/..." (W2). The entry "by hand" of a group counts as one.
void register_closed_loop();
void register_open_loop();

/// The closed loop of W1 written by hand on stock CVODE: BDF, own dense Jacobian, plant states scaled. [um, V]
struct ClosedLoop {
  std::vector<double> y, u;  ///< at k * 0.1 ms
};
ClosedLoop closed_loop_by_hand(double until, double relative_tolerance, double absolute_tolerance);
/// The same by classical Runge-Kutta with a fixed step: the reference for errors.
ClosedLoop closed_loop_reference(double until, int steps_per_row);

}  // namespace hysteron::benchmarks
