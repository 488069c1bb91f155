// Decides the block "discrete_transfer_function": a ratio of polynomials in z^-1. Does not decide its law:
// models/sampled/discrete_filter.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/sampled/discrete_filter.h"

namespace hysteron::blocks {

struct DiscreteTransferFunction {
  enum Parameter { gain, num, den, direct, before };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static std::string check(const View<double>& v);
  template <class T>
  static discrete_filter::Coefficients<T> coefficients(const View<T>& v) {
    return {v.list(num), v.list(den), v.choice(direct) == 0 ? 0u : 1u};
  }
  template <class T>
  static void output(const View<T>& v) {
    // Without direct path the input may not be known yet when the output is asked for.
    const T u = v.choice(direct) == 0 ? v.u[0] : T{0};
    v.out[0] = v.parameter(gain) * discrete_filter::output(coefficients(v), v.states(), u);
  }
  template <class T>
  static void update(const View<T>& v) {
    discrete_filter::update(coefficients(v), v.states(), v.u[0], v.out);
  }
  static void initial_states(const View<double>& v);
};

Kernel discrete_transfer_function_block();

}  // namespace hysteron::blocks
