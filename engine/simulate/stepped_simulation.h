// Decides how a diagram is taken along by somebody else's clock: inputs are set, time is advanced, outputs are read.
// The integrator stays warm from one advance to the next; it starts anew where an input jumps and at events, as in
// simulate(). Does not decide how inputs move between two calls: they are held.
#pragma once

#include <memory>
#include <vector>

#include "engine/simulate/simulate.h"

namespace hysteron {

class AdaptiveSimulation;  // adaptive_simulation.h

/// A value: a copy goes on by itself from where the original is (its integrator begins anew there). Not for two threads
/// at once; copies are independent of each other.
class SteppedSimulation {
 public:
  /// Starts at options.begin with inputs of zero. Steps always follow the error: for "exact" and the methods with fixed
  /// steps, which belong to a grid of times that is known before, "auto" is taken. options.until: how long it is
  /// probably going to last [s], against which a step is too small. Throws Error "jump_into_rate" where an input must
  /// not jump.
  SteppedSimulation(ProgramPointer program, const SimulateOptions& options);
  /// The same with a run at its start, e.g. one with other parameters.
  SteppedSimulation(ProgramPointer program, const SimulateOptions& options, Run start);
  SteppedSimulation(const SteppedSimulation& other);
  SteppedSimulation& operator=(const SteppedSimulation&) = delete;
  ~SteppedSimulation();

  const Program& program() const { return *program_; }
  double t() const;  ///< [s]
  /// Sets an input (place in program.input_names) [SI] from now on. Before the first advance that is its value at the
  /// start; later it jumps, and is there before what is sampled at the same instant. Throws Error "bad_input".
  void set(int input, double si);
  /// Goes on to `until` [s]. A diagram with inputs leaves what is due at that very instant for the next call, since the
  /// inputs of that instant are not set yet. Throws as simulate() does, and from then on Error "stepper_failed"; where
  /// it was asked to stop (engine/diagram/stop.h) Stopped, and then it stands at t(), between two steps of its
  /// integrator: another advance goes on to the same bits as if nobody had asked.
  void advance(double until);
  /// Value of a signal [SI], as the last advance left it. Throws Stopped likewise: the start may have to be settled.
  double value(int signal);
  long restarts() const;  ///< so often the integrator began anew behind its start

 private:
  void begin();
  void apply_inputs();
  template <class Action>
  auto unless_failed(const Action& action);

  ProgramPointer program_;
  SimulateOptions options_;
  Run start_;
  std::vector<std::shared_ptr<Series>> inputs_;  // of the run, one value each
  std::vector<double> wanted_;                   // their values from now on [SI]
  std::unique_ptr<AdaptiveSimulation> simulation_;
  bool failed_ = false;
};

}  // namespace hysteron
