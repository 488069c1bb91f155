// Decides the block "ramp": a straight line that begins at a given time and may end. Does not decide its formula:
// models/sources/pulses.h.
#pragma once

#include "engine/block/block.h"
#include "models/sources/pulses.h"

namespace hysteron::blocks {

struct Ramp {
  template <class T>
  struct Params {
    T slope, time, duration, initial;
  };
  template <class T>
  struct Out {
    T y;
  };
  template <class T>
  static signals::RampTimes times(const Params<T>& p) {
    return {value_of(p.time), value_of(p.duration)};
  }

  static void describe(BlockSpec<Ramp>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const Time<T>& time) {
    const int piece = times(p).piece(time.branch);
    if (piece < 0) return {p.initial};
    return {p.initial + p.slope * (piece == 0 ? T{time.t - p.time} : p.duration)};
  }
  static double next_breakpoint(const Params<double>& p, double t) { return times(p).next_breakpoint(t); }
};

Kernel ramp_block();

}  // namespace hysteron::blocks
