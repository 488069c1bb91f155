// Decides the block "triangle". Does not decide its formula nor its corners: models/sources/signals.h.
#pragma once

#include "engine/block/block.h"
#include "models/sources/signals.h"

namespace hysteron::blocks {

struct Triangle {
  template <class T>
  struct Params {
    T amplitude, offset, frequency, phase;
  };
  template <class T>
  struct Out {
    T y;
  };

  static void describe(BlockSpec<Triangle>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const Time<T>& time) {
    const double piece = signals::triangle_piece(value_of(p.frequency), value_of(p.phase), time.branch);
    return {p.offset + p.amplitude * signals::triangle(time.t, p.frequency, p.phase, piece)};
  }
  static double next_breakpoint(const Params<double>& p, double t) {
    const double next = signals::triangle_piece(p.frequency, p.phase, t) + 1;
    return signals::strictly_behind(t, signals::triangle_breakpoint(p.frequency, p.phase, next));
  }
  static double shortest_period(const Params<double>& p) { return 0.5 / p.frequency; }
};

Kernel triangle_block();

}  // namespace hysteron::blocks
