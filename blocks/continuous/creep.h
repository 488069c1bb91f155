// Decides the block "creep": slow relaxations that add to a signal. Does not decide its law: models/continuous/creep.h.
#pragma once

#include "blocks/continuous/relaxations.h"

namespace hysteron::blocks {

struct Creep : Relaxations<Creep> {
  enum Parameter { amounts, times };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = creep::output(v.list(amounts), v.states(), v.u[0]);
  }
};

Kernel creep_block();

}  // namespace hysteron::blocks
