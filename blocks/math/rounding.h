// Decides the block "rounding": the nearest of levels that are a step apart. Does not sample: the converter with a
// clock is "quantizer".
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "engine/block/block.h"

namespace hysteron::blocks {

struct Rounding {
  template <class T>
  struct Params {
    T step, zero;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Rounding>& spec);
  /// Between two levels the output does not follow the input: its derivative is 0, and that for the step the number of
  /// steps.
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    if (!(value_of(p.step) > 0)) return {in.u};
    return {std::round(value_of(in.u - p.zero) / value_of(p.step)) * p.step + p.zero};
  }
  /// Zero half way between two levels.
  static std::array<double, 1> kinks(const Params<double>& p, const In<double>& in) {
    return {p.step > 0 ? std::cos(std::numbers::pi * (in.u - p.zero) / p.step) : 1.0};
  }
};

Kernel rounding_block();

}  // namespace hysteron::blocks
