// Decides the block "rectifier": a signal mixed with its absolute value. Does not smooth the corner at zero.
#pragma once

#include <array>

#include "engine/block/block.h"

namespace hysteron::blocks {

struct Rectifier {
  template <class T>
  struct Params {
    T mix;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Rectifier>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    using std::abs;
    return {in.u + p.mix * (abs(in.u) - in.u)};
  }
  static std::array<double, 1> kinks(const Params<double>& p, const In<double>& in) {
    return {p.mix == 0 ? 1.0 : in.u};
  }
};

Kernel rectifier_block();

}  // namespace hysteron::blocks
