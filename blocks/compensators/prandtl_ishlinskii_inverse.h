// Decides the block "prandtl_ishlinskii_inverse". Does not decide its law:
// models/compensators/prandtl_ishlinskii_inverse.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/compensators/prandtl_ishlinskii_inverse.h"
#include "models/hysteresis/play.h"

namespace hysteron::blocks {

struct PrandtlIshlinskiiInverse {
  enum Parameter { thresholds, weights, sides, before };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static play::Sides sides_of(const View<T>& v) {
    return v.choice(sides) == 0 ? play::Sides::one : play::Sides::two;
  }
  // Thresholds and weights are inverted on the way through the operators: they carry the slopes of the parameters.
  template <class T>
  static void advance(const View<T>& v) {
    prandtl_ishlinskii::inverse_thresholds(v.list(thresholds), v.list(weights), v.out);
    for (int j = 0; j < v.n_m; ++j) v.out[j] = play::follow(sides_of(v), v.out[j], v.m[j], v.u[0]);
  }
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = prandtl_ishlinskii::inverse_output(v.list(weights), v.memory());
  }
  static void initial_memory(const View<double>& v);
  static void given_memory(const View<double>& v);
  static std::string check_memory(const View<double>& v);
  static std::string check(const View<double>& v);
};

Kernel prandtl_ishlinskii_inverse_block();

}  // namespace hysteron::blocks
