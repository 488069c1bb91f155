// Decides the block "soft_saturation". Does not decide its law: models/math/saturation.h.
#pragma once

#include "engine/block/block.h"
#include "models/math/saturation.h"

namespace hysteron::blocks {

struct SoftSaturation {
  template <class T>
  struct Params {
    T limit, sharpness;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<SoftSaturation>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    return {saturation::with_knee(p.limit, p.sharpness, in.u)};
  }
};

Kernel soft_saturation_block();

}  // namespace hysteron::blocks
