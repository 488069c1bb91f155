// Decides the block "saturation": a hard limit on a signal. Does not stop an integrator behind it.
#pragma once

#include <array>
#include <string>

#include "engine/block/block.h"
#include "models/math/saturation.h"

namespace hysteron::blocks {

struct Saturation {
  template <class T>
  struct Params {
    T lower, upper;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Saturation>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    return {saturation::limit(p.lower, p.upper, in.u)};
  }
  static std::array<double, 2> kinks(const Params<double>& p, const In<double>& in) {
    return {in.u - p.lower, in.u - p.upper};
  }
  static std::string check(const Params<double>& p);
};

Kernel saturation_block();

}  // namespace hysteron::blocks
