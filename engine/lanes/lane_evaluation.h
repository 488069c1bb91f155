// Decides how one evaluation of a program is carried out in lanes: steps bound to rows of numbers, blocks of fixed size
// by their functions for lanes, others lane after lane; without states and memory as one row of all lanes. Internal to
// lanes.cpp.
#pragma once

#include <span>
#include <vector>

#include "engine/lanes/lane_numbers.h"
#include "engine/lanes/lane_shared.h"
#include "engine/program/program.h"

namespace hysteron {

class LaneEvaluation {
 public:
  /// One step of a list, bound to its numbers.
  struct Call {
    Order order;
    const BlockInstance* block;
    LaneFunctions::Call function;  ///< null: lane after lane
    LanesView view;
    std::vector<const double*> u, du;
    std::vector<View<double>> views{};  ///< one per lane where the block takes a row of all of them, else empty
    std::vector<double*> y{};           ///< of such a block: its outputs
  };
  struct List {
    std::vector<Call> calls;
    SharedNumbers shared;
  };

  /// `run`: what all lanes share; its parameters are put into every lane.
  LaneEvaluation(ProgramPointer program, const Run& run, std::vector<bool> shared);

  /// Steps at times known beforehand, for the signals `read` among others.
  List make_list(const Run& run, const std::vector<Step>& steps, std::span<const int> read,
                 std::vector<SharedNumbers::Instant> instants);
  /// Numbers of a run into its lane, states into `x`.
  void place(const Run& run, int lane, LaneNumbers& x);
  /// State i of a block in a lane of `x`.
  static double state(const BlockInstance& b, LaneNumbers& x, int i, int lane);

  /// Before the first evaluation of a list, and behind that of another one.
  void begin(List& list);
  /// At place `instant` of the times of the list, which is t [s].
  void evaluate(List& list, std::size_t instant, double t, double branch, const double* x);
  /// The memory of the last evaluation becomes that of the runs.
  void commit() { m_.swap(advanced_); }

  const double* y(int signal) { return y_.row(signal); }
  LaneNumbers& dx() { return dx_; }

 private:
  Call bind(const Step& step);
  void bind_row(Call& call);
  void one_row(const Call& call);
  void one_by_one(Call& call);
  void value_of_lane(const Call& call, View<double>& v, int lane);
  void rate_of_lane(const Call& call, const View<double>& v, int lane);
  double* number(const Slot& slot) { return (slot.order == Order::value ? y_ : rate_).row(slot.index); }
  /// Numbers of a lane side by side, as blocks want them that go lane after lane.
  static bool is_lane_major(const BlockInstance& b) { return b.kernel->lanes.output == nullptr; }

  ProgramPointer program_;
  std::vector<SeriesPointer> series_;
  std::vector<bool> shared_;
  LaneNumbers p_, c_, m_, advanced_, dx_, y_, rate_;
  std::vector<double> u_, du_, out_, scratch_;
  std::vector<Dual> dual_p_, dual_u_, dual_x_, dual_m_, dual_advanced_, dual_out_;
};

}  // namespace hysteron
