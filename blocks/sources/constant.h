// Decides the block "constant": a value that never changes. Does not decide its unit: the reader or the value does.
#pragma once

#include "engine/block/block.h"

namespace hysteron::blocks {

/// In sized form because it is no function of time: a diagram with constants can still be advanced row by row.
struct Constant {
  enum Parameter { value };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape&) {
    Sizes s;
    s.feedthrough = false;
    return s;
  }
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = v.parameter(value);
  }
};

Kernel constant_block();

}  // namespace hysteron::blocks
