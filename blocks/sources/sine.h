// Decides the block "sine". Does not decide its formula: models/sources/signals.h.
#pragma once

#include "engine/block/block.h"
#include "models/sources/signals.h"

namespace hysteron::blocks {

struct Sine {
  template <class T>
  struct Params {
    T amplitude, offset, frequency, phase;
  };
  template <class T>
  struct Out {
    T y;
  };

  static void describe(BlockSpec<Sine>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const Time<T>& time) {
    return {p.offset + p.amplitude * signals::sine(time.t, p.frequency, p.phase)};
  }
  static double shortest_period(const Params<double>& p) { return 1 / p.frequency; }
};

Kernel sine_block();

}  // namespace hysteron::blocks
