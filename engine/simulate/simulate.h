// Decides what a simulation is asked for and what it gives: options, traces, statistics, and where it starts. How it is
// done stands in adaptive_step.h (adaptive ones), fixed_step.h (fixed ones) and advance.h (exactly, row by row).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/program/program.h"
#include "engine/program/tolerances.h"

namespace hysteron {

enum class Method {
  automatic,    ///< exact where the diagram allows it, else runge_kutta or bdf (choose_method.h)
  exact,        ///< row by row, instant by instant (advance.h)
  bdf,          ///< variable order and step, implicit: for stiff diagrams
  adams,        ///< variable order and step, for smooth diagrams that are not stiff
  runge_kutta,  ///< order five, explicit: restarts cost little, so for sampled inputs and many events
  euler,        ///< fixed steps (fixed_step.h)
  rk4
};

/// The names of the methods in files, in the order of Method.
const std::vector<std::string>& method_names();
const std::string& method_name(Method method);

struct SimulateOptions {
  double begin = 0;                ///< [s]
  double until = 1;                ///< [s]
  double every = 0;                ///< output step [s]; 0 = 1000 points; ignored if `instants` is given
  std::vector<double> instants{};  ///< exactly these output times [s], increasing
  std::vector<int> signals{};      ///< what to record; empty = program.record_signals
  Method method = Method::automatic;
  double relative_tolerance = default_relative_tolerance;  ///< of the results; each step is held to a quarter of it
  double absolute_tolerance = default_absolute_tolerance;  ///< times relative_tolerance and each state's nominal size
  double max_step = 0;                                     ///< [s]; 0 = worked out from the sources
  double step = 0;                                         ///< [s] of the methods with fixed steps
  bool exact_jacobian = true;                              ///< off: bdf takes differences, as a cross-check
  bool reversal_events = true;                             ///< off only to measure what they bring
  std::vector<int> slopes_for{};  ///< parameters (places in program.parameters) whose slopes are wanted
  bool at_rest = false;           ///< start in equilibrium for the inputs at `begin`
  /// Told, by the thread that simulates, which share of the span is done (0..1, rising): at most every 50 ms, and not
  /// by the exact advance, which is there at once. The results do not depend on it.
  std::function<void(double)> progress{};
};

/// What it took to solve one algebraic loop, in the evaluations of the simulation itself (not in those for slopes).
struct LoopStatistics {
  std::string path;
  long solved = 0, failed = 0;
  long evaluations = 0;       ///< of the blocks in the loop
  long bracketed = 0;         ///< solved between two points at which the residual has different signs
  int most_evaluations = 0;   ///< for one solution
  double worst_residual = 0;  ///< left in one of its numbers, relative to its size
};

/// Where the time went [s]; the rest of Statistics::seconds is the setting up. Differs from run to run.
struct Phases {
  double integrate = 0;  ///< steps and acceptance of memory
  double events = 0;     ///< corners, samples, changes of mode, reversals and restarts
  double output = 0;
};

struct Statistics {
  std::string method;
  long steps = 0, rejected = 0, evaluations = 0, jacobians = 0, reversals = 0, restarts = 0;
  long samples = 0;                                          ///< runs of sampled blocks
  long paths = 0;                                            ///< jumps that rate-independent laws followed
  std::vector<std::pair<std::string, long>> mode_changes{};  ///< per block with modes
  std::vector<LoopStatistics> loops{};                       ///< as in Program::loops; none behind the exact advance
  std::string why{};                                         ///< why `method` was taken, where it was chosen
  std::vector<std::string> warnings{};                       ///< why the result may be wrong, with the cure
  Phases phases{};
  double seconds = 0;  ///< all of it
};

struct Traces {
  std::vector<double> t;  ///< [s]
  std::vector<int> signals;
  std::vector<std::vector<double>> values;  ///< [signal][instant], SI
  /// [parameter][signal][instant]: d(signal)/d(parameter), SI, as SimulateOptions::slopes_for asks.
  std::vector<std::vector<std::vector<double>>> slopes{};
  Statistics statistics;
  std::optional<Run> end{};  ///< where the simulation stopped; absent behind the exact advance
};

/// Simulates a copy of `run` (its inputs bound). Throws Error(Fault::numerics) naming block, time and states where it
/// fails.
Traces simulate(const Program& program, Run run, const SimulateOptions& options);

/// Options from the diagram's "simulate" section; what it does not say stays as in `defaults`.
SimulateOptions simulate_options(const Program& program, SimulateOptions defaults = {});

}  // namespace hysteron
