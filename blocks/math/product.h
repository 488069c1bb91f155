// Decides the block "product" of two signals. For more factors put two of them in a row.
#pragma once

#include "engine/block/block.h"

namespace hysteron::blocks {

struct Product {
  template <class T>
  struct In {
    T a, b;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Product>& spec);
  template <class T>
  static Out<T> output(const Nothing&, const In<T>& in) {
    return {in.a * in.b};
  }
};

Kernel product_block();

}  // namespace hysteron::blocks
