// Decides how one feedback loop with nonlinear blocks moves from point to point: its states together, by the
// Runge-Kutta formula, linear blocks as sums (loop_matrices.h), what decays in a mode exactly, or, where a law asks for
// the rate of its input, along the program's own steps; where a block of it changes its mode, the way is cut right
// behind. Does not decide which blocks are one loop: advance_graph.h. Internal to the exact advance.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/integrators/root_bracket.h"
#include "engine/rowwise/advance_plan.h"
#include "engine/rowwise/exponential_step.h"
#include "engine/rowwise/loop_matrices.h"

namespace hysteron {

class AdvanceLoop {
 public:
  /// Moves the states `x`, and the memory and modes of `run`, which `work` is bound to; all outlive it. jets: made when
  /// the first loop needs them.
  AdvanceLoop(const AdvancePlan& plan, const AdvancePlan::LoopedPart& part, Run& run, Work& work,
              std::vector<double>& x, std::unique_ptr<JetWork>& jets);

  /// Nothing moves at the start. accept: memory and modes are those of the first point.
  void start(bool accept);
  /// The inputs go from their values at the last point to those in Work::y; h [s] behind it, 0: they jump.
  /// path_steps: Runge-Kutta steps of a rate-independent law along a jump.
  void move(double h, int path_steps);

 private:
  void follow_jump(int path_steps);
  void follow_row(double h);
  double to_the_next_change(double begin, double h);
  void step(double begin, double end, double length, double duration);
  void put_inputs(double place);
  void put_states(const std::vector<double>& values);
  void derivatives();
  void values();
  void accept_values();
  void settle();
  bool look_at_guards(std::vector<double>& g);
  void change_modes(const std::vector<double>& g);
  ExponentialStep* in_this_mode(double length);
  std::vector<double> slopes();
  [[noreturn]] void report_unsettled(const char* code, int changes) const;

  const AdvancePlan& plan_;
  const AdvancePlan::LoopedPart& part_;
  const Program& program_;
  struct InMode {
    std::vector<int> modes;  ///< of the blocks that have some
    ExponentialStep step;
  };

  std::optional<LoopMatrices> matrices_;
  std::unique_ptr<JetWork>& jets_;
  std::vector<InMode> known_;  ///< of this run
  ExponentialStep* now_in_ = nullptr;
  bool is_affine_ = false;  ///< in each mode, at the numbers of this run
  Run& run_;
  Work& work_;
  std::vector<double>& x_;
  // Inputs at the last point and now; states of the loop as they are moved and where a step began.
  std::vector<double> before_, now_, states_, began_, scratch_;
  std::vector<double> guard_, reset_;
  WatchedValues begin_, end_;
};

}  // namespace hysteron
