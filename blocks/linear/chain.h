// Decides what blocks share that are a chain of states behind a gain: output, rates and rest. Does not decide the
// chain: models/linear/linear_system.h.
#pragma once

#include <algorithm>
#include <limits>

#include "engine/block/block.h"
#include "models/linear/linear_system.h"

namespace hysteron::blocks {

/// Of a block whose first parameter is its gain and whose constants are a chain.
struct ChainOfStates {
  /// direct: the input acts at once. Without that it may not be known yet when the output is asked for.
  template <class T>
  static void chain_output(const View<T>& v, bool direct) {
    v.out[0] = v.parameter(0) * linear_system::output(linear_system::chain_at(v.c, v.n_x), v.x, direct ? v.u[0] : T{0});
  }
  template <class T>
  static void derivative(const View<T>& v) {
    linear_system::derivative(linear_system::chain_at(v.c, v.n_x), v.x, v.u[0], v.out);
  }
  static void rest(const View<double>& v) {
    const auto chain = linear_system::chain_at(v.c, v.n_x);
    std::fill(v.out, v.out + v.n_x, 0.0);
    if (v.n_x == 0) return;
    const auto last = static_cast<std::size_t>(v.n_x) - 1;
    // x_n' = row_1 x_1 + up_n u = 0. Without a constant in the denominator a constant input has no equilibrium: not a
    // number says so.
    if (chain.row[0] != 0)
      v.out[0] = -chain.up[last] * v.u[0] / chain.row[0];
    else if (v.u[0] != 0)
      v.out[0] = std::numeric_limits<double>::quiet_NaN();
  }
};

}  // namespace hysteron::blocks
