// Decides the block "creep": slow relaxations that add to a signal. Does not decide its law: models/creep.h.
#pragma once

#include "engine/block.h"
#include "models/creep.h"

namespace hysteron::blocks {

struct Creep {
  enum Parameter { amounts, times };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = creep::output(v.list(amounts), v.states(), v.u[0]);
  }
  template <class T>
  static void derivative(const View<T>& v) {
    const auto tau = v.list(times);
    for (std::size_t k = 0; k < tau.size(); ++k) v.out[k] = creep::relaxation_rate(tau[k], v.x[k], v.u[0]);
  }
  static void rest(const View<double>& v) {
    for (int k = 0; k < v.n_x; ++k) v.out[k] = v.u[0];
  }
};

Kernel creep_block();

}  // namespace hysteron::blocks
