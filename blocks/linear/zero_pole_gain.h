// Decides the block "zero_pole_gain": zeros and poles as numbers. Does not decide its states:
// models/linear/linear_system.h.
#pragma once

#include <string>

#include "blocks/linear/chain.h"

namespace hysteron::blocks {

struct ZeroPoleGain : ChainOfStates {
  enum Parameter { gain, zeros, zero_pairs, poles, pole_pairs };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static void prepare(const View<double>& v);
  template <class T>
  static void output(const View<T>& v) {
    chain_output(v, v.list(zeros).size() + v.list(zero_pairs).size() == static_cast<std::size_t>(v.n_x));
  }
};

Kernel zero_pole_gain_block();

}  // namespace hysteron::blocks
