// Decides the block "delay_line": a whole number of samples. Does not decide its law: models/sampled/delay_line.h.
#pragma once

#include "engine/block/block.h"
#include "models/sampled/delay_line.h"

namespace hysteron::blocks {

struct DelayLine {
  enum Parameter { samples, before };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = v.n_x > 0 ? v.x[0] : v.u[0];  // a delay does not know its input yet when the output is asked for
  }
  template <class T>
  static void update(const View<T>& v) {
    delay_line::push(v.states(), v.u[0], v.out);
  }
  static void initial_states(const View<double>& v);
};

Kernel delay_line_block();

}  // namespace hysteron::blocks
