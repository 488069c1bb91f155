// Decides which workloads are timed and what each reports. The reporter in main.cpp turns the times into ratios.
#pragma once

#include <vector>

#include "engine/program/program.h"

namespace hysteron::benchmarks {

// Each registers its groups; the entry "by hand" of a group counts as one.
void register_closed_loop();    ///< WORKLOADS W1: CVODE, and Runge-Kutta with a fixed step
void register_open_loop();      ///< W2: 10 and 80 play operators on a recorded input
void register_chains();         ///< W3: chains of 10, 100, 1000 lags
void register_creep();          ///< a plant with relaxations on 20 000 recorded rows
void register_lanes();          ///< value and slopes of a law on a recording, runs side by side
void register_evaluation();     ///< one evaluation of a diagram, per block
void register_expression();     ///< a law that the diagram writes, against the same law in C++
void register_sampled_loop();   ///< 10 kHz PI, Jiles-Atherton inverse, plant
void register_single_blocks();  ///< one block on recorded rows, each against a loop for its law

/// The closed loop of W1 written by hand on stock CVODE: BDF, own dense Jacobian, plant states scaled. [um, V]
struct ClosedLoop {
  std::vector<double> y, u;  ///< at k * 0.1 ms
};
ClosedLoop closed_loop_by_hand(double until, double relative_tolerance, double absolute_tolerance);
/// The same by classical Runge-Kutta with a fixed step: with many steps a row the reference for errors.
ClosedLoop closed_loop_in_fixed_steps(double until, int steps_per_row);
/// The same as a diagram.
ProgramPointer closed_loop_program();
/// Its right-hand side: six states, t in s.
void closed_loop_derivative(double t, const double* x, double* dx);

/// x_0, x_(N/2), x_(N-1) of W3 every 1 ms until 1 s, on stock CVODE (BDF) and KLU with an own sparse Jacobian.
std::vector<std::vector<double>> chain_by_hand(int lags, double relative_tolerance, double absolute_tolerance);
double chain_time_constant(int lag);  ///< [s]

}  // namespace hysteron::benchmarks
