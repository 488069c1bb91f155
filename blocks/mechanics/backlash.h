// Decides the block "backlash": a joint with a gap. Does not decide its law: models/hysteresis/play.h.
#pragma once

#include "engine/block/block.h"
#include "models/hysteresis/play.h"

namespace hysteron::blocks {

struct Backlash {
  template <class T>
  struct Params {
    T gap, before;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Memory {
    T w;  // driven side at the last accepted point
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Backlash>& spec);
  template <class T>
  static Memory<T> advance(const Params<T>& p, const Memory<T>& m, const In<T>& in) {
    return {play::backlash(p.gap, m.w, in.u)};
  }
  template <class T>
  static Out<T> output(const Params<T>&, const Memory<T>& advanced, const In<T>&) {
    return {advanced.w};
  }
  static Memory<double> start(const Params<double>& p) { return {play::backlash(p.gap, 0.0, p.before)}; }
};

Kernel backlash_block();

}  // namespace hysteron::blocks
