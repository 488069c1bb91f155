// Decides the block "repetitive_controller". Does not decide its law: models/sampled/repetitive.h.
#pragma once

#include "engine/block/block.h"
#include "models/sampled/repetitive.h"

namespace hysteron::blocks {

struct RepetitiveController {
  enum Parameter { samples, gain, lead, keep, smoothing };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] =
        repetitive::output(v.states(), v.parameter(gain), v.parameter(keep), v.parameter(smoothing), v.choice(lead));
  }
  template <class T>
  static void update(const View<T>& v) {
    repetitive::update(v.states(), v.parameter(keep), v.parameter(smoothing), v.u[0], v.out);
  }
};

Kernel repetitive_controller_block();

}  // namespace hysteron::blocks
