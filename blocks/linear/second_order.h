// Decides the block "second_order": low-pass, band-pass or high-pass by frequency and damping. Does not decide its law:
// models/linear/second_order.h.
#pragma once

#include "engine/block/block.h"
#include "models/linear/resonance.h"
#include "models/linear/second_order.h"

namespace hysteron::blocks {

struct SecondOrder {
  enum Parameter { gain, frequency, damping, pass };
  enum Pass { low, band, high };
  // States: the input q behind the low-pass, then v = q'/w.

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    const T& z = v.parameter(damping);
    const int kind = v.choice(pass);
    // Without direct path the input may not be known yet when the output is asked for.
    const T u = kind == high ? v.u[0] : T{0};
    const second_order::Numerator<T> n = kind == low    ? second_order::Numerator<T>{}
                                         : kind == band ? second_order::Numerator<T>{T{0}, 2.0 * z, T{0}}
                                                        : second_order::Numerator<T>{T{0}, T{0}, T{1}};
    v.out[0] = v.parameter(gain) * second_order::output(n, z, v.x[0], v.x[1], u);
  }
  template <class T>
  static void derivative(const View<T>& v) {
    const auto rate = resonance::rates(v.parameter(frequency), v.parameter(damping), v.x[0], v.x[1], v.u[0]);
    v.out[0] = rate.q;
    v.out[1] = rate.v;
  }
  static void rest(const View<double>& v);
};

Kernel second_order_block();

}  // namespace hysteron::blocks
