// Decides the block "play": one play operator. Does not decide its law: models/hysteresis/play.h.
#pragma once

#include "engine/block/block.h"
#include "models/hysteresis/play.h"

namespace hysteron::blocks {

struct Play {
  template <class T>
  struct Params {
    T radius, sides, before;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Memory {
    T w;  // output at the last accepted point
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Play>& spec);
  template <class T>
  static Memory<T> advance(const Params<T>& p, const Memory<T>& m, const In<T>& in) {
    return {play::follow(value_of(p.sides) == 0 ? play::Sides::two : play::Sides::one, p.radius, m.w, in.u)};
  }
  template <class T>
  static Out<T> output(const Params<T>&, const Memory<T>& advanced, const In<T>&) {
    return {advanced.w};
  }
  static Memory<double> start(const Params<double>& p) { return advance(p, Memory<double>{0}, In<double>{p.before}); }
};

Kernel play_block();

}  // namespace hysteron::blocks
