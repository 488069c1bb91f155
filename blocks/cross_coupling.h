// Decides the block "cross_coupling": a share of another axis' signal is added. Static; put a lag in its wire where the
// other axis acts late.
#pragma once

#include "engine/block.h"

namespace hysteron::blocks {

struct CrossCoupling {
  template <class T>
  struct Params {
    T coefficient;
  };
  template <class T>
  struct In {
    T u, other;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<CrossCoupling>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    return {in.u + p.coefficient * in.other};
  }
};

Kernel cross_coupling_block();

}  // namespace hysteron::blocks
