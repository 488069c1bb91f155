// Decides the block "discrete_state_space": four matrices from instant to instant. What it shares with the continuous
// one stands in blocks/linear/state_space.h.
#pragma once

#include "blocks/linear/state_space.h"

namespace hysteron::blocks {

struct DiscreteStateSpace : Matrices {
  static void describe(Declaration& spec);
  static Sizes sizes(const Shape& shape);

  template <class T>
  static void update(const View<T>& v) {
    moved(v);
  }
};

Kernel discrete_state_space_block();

}  // namespace hysteron::blocks
