// Decides the block "divide": one signal by another.
#pragma once

#include "engine/block/block.h"

namespace hysteron::blocks {

struct Divide {
  template <class T>
  struct In {
    T a, b;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Divide>& spec);
  template <class T>
  static Out<T> output(const Nothing&, const In<T>& in) {
    return {in.a / in.b};
  }
};

Kernel divide_block();

}  // namespace hysteron::blocks
