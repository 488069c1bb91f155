// Decides the block "sensor_drift": a reading that runs away steadily. Does not decide random walks.
#pragma once

#include "engine/block/block.h"

namespace hysteron::blocks {

struct SensorDrift {
  static constexpr bool uses_time = true;
  enum Parameter { rate, zero };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape&) { return {}; }
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = v.u[0] + v.parameter(zero) + v.parameter(rate) * v.t;
  }
};

Kernel sensor_drift_block();

}  // namespace hysteron::blocks
