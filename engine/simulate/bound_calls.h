// Decides how block functions are called again and again for one set of parameter values and states that stay where
// they are: what they see is put together once, so that a call gathers inputs that do not stand side by side, and
// calls. What needs more than that (memory, sampled blocks, what can be switched off, loops) is not called here:
// steps.h. Numbers are those of steps.h to the last bit.
#pragma once

#include <array>
#include <deque>
#include <span>
#include <vector>

#include "engine/program/program.h"

namespace hysteron {

class BoundCalls {
 public:
  struct Copy {
    double* to;
    const double* from;
  };
  /// A function whose arguments carry their rates: these are `numbers`, parameters first and outputs last, into which
  /// and out of which plain numbers are copied.
  struct DualCall {
    Functions<double>::RateCall function = nullptr;
    View<Dual> view{};
    std::vector<Dual> numbers{};
  };
  struct Call {
    Functions<double>::Call function = nullptr;
    DualCall* dual = nullptr;              ///< in place of the function; of duals_
    std::vector<Copy> before{}, behind{};  ///< behind: of a source all of its numbers
    View<double> view{};
    Step step{};
    int series = -1;  ///< into Run::series
  };

  /// Keeps references to the program and to `work`, whose arrays must stay where they are, as the states `x` must.
  BoundCalls(const Program& program, Work& work, const double* x) : program_(program), work_(work), x_(x) {}

  /// What carries the step out; null where that needs more than a call.
  Call* add(const Step& step);
  /// A step that is nothing but its function: nothing to gather before, nothing to hand on behind.
  static bool is_function(const Program& program, const Step& step) {
    const BlockInstance& b = program.blocks[static_cast<std::size_t>(step.block)];
    return step.order != Order::rate && (b.adjacent >= 0 || b.n_u == 0);
  }
  /// The arrays of `run` are not those of the last evaluation: before the first evaluation, and of a copied run.
  bool is_bound_to(const Run& run) const {
    return bound_to_[0] == run.p.data() && bound_to_[1] == run.c.data() && bound_to_[2] == run.m.data() &&
           bound_to_[3] == run.histories.data();
  }
  void bind(const Run& run);
  /// What evaluations at one instant have in common: time, piece and series of one call, or of all that are no sources
  /// of time alone.
  static void set_time(Call& call, const Run& run, double t);
  void set_time(const Run& run, double t) {
    for (Call* const call : timed_) set_time(*call, run, t);
  }
  /// What every evaluation has of its own: modes, and sides of kinks.
  bool have_modes() const { return !moded_.empty() || !sided_.empty(); }
  void set_modes(const Run& run) {
    for (const Moded& moded : moded_) *moded.mode = run.mode[static_cast<std::size_t>(moded.index)];
    for (const Sided& sided : sided_) *sided.sides = run.sides.empty() ? nullptr : run.sides.data() + sided.index;
  }

  static void carry_out(const Call& call) {
    for (const Copy& copy : call.before) *copy.to = *copy.from;
    if (call.dual == nullptr) return call.function(call.view);
    call.dual->function(call.dual->view);
    for (const Copy& copy : call.behind) *copy.to = *copy.from;
  }
  /// Of a source of time: its numbers at these instants, of each output the rate, where that is asked for, and the
  /// value; those of the next instant stand `stride` further on. Returns how many there are of one instant.
  static std::size_t ask(Call& call, const Run& run, std::span<const double> instants, double* numbers,
                         std::size_t stride);

 private:
  void bind_plain(Call& call);
  void bind_rate(Call& call);
  void bind_dual(Call& call);
  static void copy_inputs(Call& call, const BlockInstance& b, const std::vector<double>& from, double* to);
  void follow(Call& call);

  const Program& program_;
  Work& work_;
  const double* x_;
  std::deque<Call> calls_;  // whose places stay
  std::deque<DualCall> duals_;
  std::array<const void*, 4> bound_to_{};
  struct Moded {
    int* mode;
    int index;
  };
  struct Sided {
    const signed char** sides;
    int index;
  };
  std::vector<Call*> timed_;
  std::vector<Moded> moded_;
  std::vector<Sided> sided_;
};

}  // namespace hysteron
