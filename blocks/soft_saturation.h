// Decides the block "soft_saturation": a limit that is approached with a knee. For a sharp one: saturation.
#pragma once

#include <cmath>

#include "engine/block.h"

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
    using std::abs;
    using std::exp;
    using std::log;
    const T size = abs(in.u / p.limit);
    if (!(size > T(0.0))) return {in.u};
    // 1 + size^n without overflow, whichever of the two is larger.
    const T power = p.sharpness * log(size);
    if (power > T(0.0)) return {(in.u / size) * exp(-log(1.0 + exp(-power)) / p.sharpness)};
    return {in.u * exp(-log(1.0 + exp(power)) / p.sharpness)};
  }
};

Kernel soft_saturation_block();

}  // namespace hysteron::blocks
