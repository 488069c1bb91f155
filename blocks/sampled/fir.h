// Decides the blocks "fir" and "moving_average": weighted sums over the last samples. Does not decide their laws:
// models/sampled/fir.h.
#pragma once

#include "engine/block/block.h"
#include "models/sampled/delay_line.h"
#include "models/sampled/fir.h"

namespace hysteron::blocks {

struct Fir {
  enum Parameter { coefficients, before };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = fir::output(v.list(coefficients), v.states(), v.u[0]);
  }
  template <class T>
  static void update(const View<T>& v) {
    delay_line::push(v.states(), v.u[0], v.out);
  }
  static void initial_states(const View<double>& v);
};

struct MovingAverage {
  enum Parameter { samples, before };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = fir::mean(v.states(), v.u[0]);
  }
  template <class T>
  static void update(const View<T>& v) {
    delay_line::push(v.states(), v.u[0], v.out);
  }
  static void initial_states(const View<double>& v);
};

Kernel fir_block();
Kernel moving_average_block();

}  // namespace hysteron::blocks
