// Decides the block "transfer_function": a ratio of polynomials in s. Does not decide its states:
// models/linear/linear_system.h.
#pragma once

#include <string>

#include "blocks/linear/chain.h"

namespace hysteron::blocks {

struct TransferFunction : ChainOfStates {
  enum Parameter { gain, num, den };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static std::string check(const View<double>& v);
  static void prepare(const View<double>& v);

  template <class T>
  static void output(const View<T>& v) {
    chain_output(v, v.list(num).size() == v.list(den).size());
  }
};

Kernel transfer_function_block();

}  // namespace hysteron::blocks
