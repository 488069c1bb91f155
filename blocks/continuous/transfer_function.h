// Decides the block "transfer_function": a ratio of polynomials in s. Does not decide its states:
// models/continuous/linear_system.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/continuous/linear_system.h"

namespace hysteron::blocks {

struct TransferFunction {
  enum Parameter { gain, num, den };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static std::string check(const View<double>& v);
  static void prepare(const View<double>& v);

  template <class T>
  static void output(const View<T>& v) {
    // Without direct path (d = 0 by shape) the input may not be known yet when the output is asked for.
    const bool direct = v.list(num).size() == v.list(den).size();
    v.out[0] =
        v.parameter(gain) * linear_system::output(linear_system::chain_at(v.c, v.n_x), v.x, direct ? v.u[0] : T{0});
  }
  template <class T>
  static void derivative(const View<T>& v) {
    linear_system::derivative(linear_system::chain_at(v.c, v.n_x), v.x, v.u[0], v.out);
  }
  static void rest(const View<double>& v);
};

Kernel transfer_function_block();

}  // namespace hysteron::blocks
