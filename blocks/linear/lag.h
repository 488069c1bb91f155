// Decides the block "lag": real poles in a row with gain one. Does not resonate: transfer_function does.
#pragma once

#include "engine/block/block.h"
#include "models/continuous/creep.h"

namespace hysteron::blocks {

struct Lag {
  enum Parameter { times };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = v.x[v.n_x - 1];
  }
  template <class T>
  static void derivative(const View<T>& v) {
    const auto tau = v.list(times);
    for (std::size_t k = 0; k < tau.size(); ++k)
      v.out[k] = creep::relaxation_rate(tau[k], v.x[k], k == 0 ? v.u[0] : v.x[k - 1]);
  }
  static void rest(const View<double>& v) {
    for (int k = 0; k < v.n_x; ++k) v.out[k] = v.u[0];
  }
};

Kernel lag_block();

}  // namespace hysteron::blocks
