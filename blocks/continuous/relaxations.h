// Decides what blocks of slow relaxations share: states that follow the input, each with a time constant of its own.
// Does not decide what they add to the output.
#pragma once

#include "engine/block/block.h"
#include "models/continuous/creep.h"

namespace hysteron::blocks {

/// Of a block B whose list B::times [s] has one time constant per state.
template <class B>
struct Relaxations {
  template <class T>
  static void derivative(const View<T>& v) {
    const auto tau = v.list(B::times);
    for (std::size_t k = 0; k < tau.size(); ++k) v.out[k] = creep::relaxation_rate(tau[k], v.x[k], v.u[0]);
  }
  static void rest(const View<double>& v) {
    for (int k = 0; k < v.n_x; ++k) v.out[k] = v.u[0];
  }
};

}  // namespace hysteron::blocks
