// Decides the block "sliding_friction": friction on a wire that carries a speed, for what is behind it a dashpot. Does
// not decide how it sticks and slides: models/mechanics/presliding.h.
#pragma once

#include "engine/block/block.h"
#include "models/mechanics/presliding.h"

namespace hysteron::blocks {

struct SlidingFriction {
  template <class T>
  struct Params {
    T level, slip_distance, crossover;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct State {
    T share;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<SlidingFriction>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {in.u + p.level * s.share};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {presliding::yield_rate(p.slip_distance, p.crossover, s.share, in.u)};
  }
  /// It holds nothing at rest; a recording that begins in motion finds it sliding.
  static State<double> rest(const Params<double>& p, const In<double>& in) {
    return {presliding::sliding_share(p.crossover, in.u)};
  }
};

Kernel sliding_friction_block();

}  // namespace hysteron::blocks
