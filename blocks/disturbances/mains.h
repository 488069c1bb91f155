// Decides the block "mains_interference". Does not decide its formula: models/disturbances/mains.h.
#pragma once

#include "engine/block/block.h"
#include "models/disturbances/mains.h"

namespace hysteron::blocks {

struct MainsInterference {
  static constexpr bool uses_time = true;
  enum Parameter { frequency, cosine, sine };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = v.u[0] + mains::hum(v.parameter(frequency), v.list(cosine), v.list(sine), v.t);
  }
};

Kernel mains_interference_block();

}  // namespace hysteron::blocks
