// Decides the block "step": one jump. Does not decide what a jump does to the blocks behind it.
#pragma once

#include "engine/block/block.h"
#include "models/sources/signals.h"

namespace hysteron::blocks {

struct StepSource {
  template <class T>
  struct Params {
    T before, after, time;
  };
  template <class T>
  struct Out {
    T y;
  };
  static constexpr Smoothness smoothness = Smoothness::jumps;

  static void describe(BlockSpec<StepSource>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const Time<T>& time) {
    return {time.branch < value_of(p.time) ? p.before : p.after};
  }
  static double next_breakpoint(const Params<double>& p, double t) { return t < p.time ? p.time : signals::never; }
};

Kernel step_block();

}  // namespace hysteron::blocks
