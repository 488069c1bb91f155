// Decides the block "constant": a value that never changes. Does not decide its unit: the reader or the value does.
#pragma once

#include "engine/block.h"

namespace hysteron::blocks {

struct Constant {
  template <class T>
  struct Params {
    T value;
  };
  template <class T>
  struct Out {
    T y;
  };

  static void describe(BlockSpec<Constant>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const Time<T>&) {
    return {p.value};
  }
};

Kernel constant_block();

}  // namespace hysteron::blocks
