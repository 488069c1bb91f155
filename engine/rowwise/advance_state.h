// Decides what one run of an exact advance has at a point and how it goes on from there: the start, a step, a jump of
// the sources, a sampling instant. Does not decide where the points are: advance_points.h. Internal to the exact
// advance.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/events/sampling.h"
#include "engine/rowwise/advance_loop.h"
#include "engine/rowwise/advance_plan.h"

namespace hysteron {

class AdvanceState {
 public:
  explicit AdvanceState(const AdvancePlan& plan);
  ~AdvanceState();
  AdvanceState(const AdvanceState&) = delete;
  AdvanceState& operator=(const AdvanceState&) = delete;

  /// Goes on with a copy of `start`; path_steps: Runge-Kutta steps of a rate-independent law along a jump.
  /// series: of AdvancePlan::series.
  void take(const Run& start, std::vector<SeriesPointer> series, int path_steps);

  /// `due`, here as below: places in Program::sampled_blocks of those that run at t.
  void start(std::span<const int> due, double t, double branch, bool at_rest, Sampling& sampling);
  void step(double t, double h, double branch);
  /// Sources of the run jump at t.
  void jump(double t, double branch);
  /// Sampled blocks run at t.
  void hit(std::span<const int> due, double t, Sampling& sampling);
  /// What depends on the time, before anything is evaluated there.
  void at_time(double t, double branch);
  void evaluate(int block) { steps_value(block); }

  /// Remembers and asks the past of a dead time, whose input stands in y.
  void look_back(int block, double t);
  /// A loop with nonlinear blocks: AdvanceLoop::move.
  void move_loop(int loop, double h) { loops_[static_cast<std::size_t>(loop)].move(h, path_steps_); }
  int path_steps_of(int block) const { return plan_.is_rate_independent(block) ? path_steps_ : 0; }

  // Of the run, read and written row by row, too (advance_rows.h).
  Run run;
  std::vector<SeriesPointer> sources;  ///< of AdvancePlan::series
  Work work;
  std::vector<double>& y;  ///< per signal
  std::vector<double> x;   ///< states of nonlinear blocks, in the order of the program
  std::vector<LinearPart> parts;
  long hits = 0;

 private:
  void steps_value(int block);
  void follow(int block, double t, double h);
  void move_states(int block, double h);
  void remember_inputs(int block);
  void foresee(int block);
  void start_block(int block, double t, bool accept);
  void rest_histories(double t, bool accept);
  void begin_behind(double t, bool accept);
  void sample_until_at_rest(std::span<const int> due, double t, const std::vector<double>& memory, Sampling& sampling);
  void sample(std::span<const int> due, double t, Sampling& sampling);
  void pass_on(double t, bool with_delays);
  void pass_on_samples(double t, bool with_delays);
  template <class PassOn>
  void walk(const std::vector<int>& jumping, PassOn pass);
  void remember_from(const std::vector<int>& jumping);

  const AdvancePlan& plan_;
  const Program& program_;
  int path_steps_ = 1;
  std::vector<double> from_, to_;
  // Of blocks with nonlinear states: inputs at the last point and now, side by side; where they and the outputs stand.
  std::vector<double> inputs_, scratch_;
  std::vector<const double*> input_places_;
  std::vector<double*> output_places_;
  std::unique_ptr<JetWork> jets_;  ///< of all loops
  std::vector<AdvanceLoop> loops_;
};

}  // namespace hysteron
