// Decides what a simulation in adaptive steps keeps between two of them, so that it can also be taken piece by piece
// (stepped_simulation.h) without the integrator starting anew. Internal to the ways of simulating; defined in
// adaptive_step.cpp.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/diagram/stop.h"
#include "engine/events/events.h"
#include "engine/events/reversals.h"
#include "engine/events/zero_crossings.h"
#include "engine/integrators/integrator.h"
#include "engine/program/histories.h"
#include "engine/program/nominal.h"
#include "engine/simulate/divergence.h"
#include "engine/simulate/forward_sensitivities.h"
#include "engine/simulate/jacobian.h"
#include "engine/simulate/linear_row_kernel.h"
#include "engine/simulate/simulate_parts.h"
#include "engine/simulate/step_defects.h"
#include "engine/simulate/trace_recorder.h"

namespace hysteron {

class AdaptiveSimulation {
 public:
  /// Where a simulation is asked for that goes from communication to communication there are no instants to record.
  AdaptiveSimulation(const Program& program, Run run, SimulateOptions options, std::vector<double> instants,
                     std::vector<int> signals);
  /// Goes on from where `other` is, with `run`, which is other.at_present() or has series of its own in it. The
  /// integrator begins anew.
  AdaptiveSimulation(const AdaptiveSimulation& other, Run run);
  AdaptiveSimulation(const AdaptiveSimulation&) = delete;
  AdaptiveSimulation& operator=(const AdaptiveSimulation&) = delete;

  /// All of it, with what it recorded.
  Traces operator()();

  // The same piece by piece. Each throws as operator() does.
  /// What is due at the start.
  void begin();
  /// To `end` [s]. `with_its_events`: corners and samples that are due there happen, else they wait for the next call.
  void advance(double end, bool with_its_events);
  /// Inputs of the diagram jump now: `change` sets them in the run.
  void jump_inputs(const std::function<void()>& change);

  double t() const { return t_; }  ///< [s]
  /// Value of a signal now [SI].
  double value(int signal);
  Run at_present() const;
  long restarts() const { return solver_->counters().restarts; }

 private:
  std::unique_ptr<Integrator> make_solver();
  int reversals() const { return options_.reversal_events ? reversals_.count() : 0; }
  bool derivative(double t, const double* x, double* dx);
  void indicate(double t, const double* x, double* g);
  void make_sensitivities();
  void restart() {
    crossings_.choose_sides(run_, work_, t_, x_);
    crossings_.forget();
    solver_->start(t_, x_, s_);
  }
  void take_step(double stop);
  void pass_instant();
  void happen(const std::function<bool()>& what);
  [[noreturn]] void explain(const Error& error);
  std::optional<ZeroCrossings::Found> find_crossing();
  bool begin_anew(const ZeroCrossings::Found& crossing);
  void pass_look() {
    if (t_ >= look_at_ - same_instant(t_)) look_at_ = std::exchange(then_at_, std::numeric_limits<double>::infinity());
  }
  bool begin_anew_before_reversal();
  void pass_crossing(const ZeroCrossings::Found& crossing);
  void pass_root();
  void switch_modes(const std::vector<int>& turned, const std::vector<int>& fell);
  void check_guards();
  void follow_directions();
  void commit();
  void check_pace();

  const Program& program_;
  Run run_;
  const SimulateOptions options_;
  Work work_;
  LinearRowKernel derivative_;
  LookUp look_up_;
  HowFar how_far_;
  NominalSizes sizes_;
  GrowthWatch growth_;
  std::vector<double> tolerance_;  // absolute, per state
  Events events_;
  Reversals reversals_;
  ZeroCrossings crossings_;
  Histories histories_;
  std::unique_ptr<Jacobian> jacobian_;                      // before the solver, which calls it
  std::unique_ptr<ForwardSensitivities> sensitivities_of_;  // as well; null if no slopes are asked for
  std::vector<double> s_;                                   // dx/dp by columns
  std::unique_ptr<Integrator> solver_;
  TraceRecorder recorder_;
  Statistics statistics_;
  std::optional<StepDefects> defects_;      // of the solver's steps
  std::vector<double> x_, before_, after_;  // x_ has one dummy state where the program has none
  std::function<void(double, std::vector<double>&)> states_inside_;  // of the last step
  ZeroCrossings::Noticed noticed_;
  double t_ = 0, until_ = 0, milestone_ = 0;
  // Steps have to end here, before a kink, and then there, behind it [s].
  double look_at_ = std::numeric_limits<double>::infinity(), then_at_ = look_at_;
  long steps_since_milestone_ = 0;
  bool not_finite_ = false;  // the last derivative was not; then these are where
  double bad_t_ = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> bad_x_;
};

}  // namespace hysteron
