// Decides the blocks "abs" and "sign": the size of a signal and its direction.
#pragma once

#include <array>
#include <cmath>

#include "engine/block/block.h"
#include "models/number.h"

namespace hysteron::blocks {

struct Absolute {
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Absolute>& spec);
  template <class T>
  static Out<T> output(const Nothing&, const In<T>& in) {
    using std::abs;
    return {abs(in.u)};
  }
  static std::array<double, 1> kinks(const Nothing&, const In<double>& in) { return {in.u}; }
};

struct Sign {
  static constexpr Smoothness smoothness = Smoothness::jumps;
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Sign>& spec);
  template <class T>
  static Out<T> output(const Nothing&, const In<T>& in) {
    return {T(in.u > T(0.0) ? 1.0 : in.u < T(0.0) ? -1.0 : 0.0)};
  }
  static std::array<double, 1> kinks(const Nothing&, const In<double>& in) { return {in.u}; }
};

Kernel abs_block();
Kernel sign_block();

}  // namespace hysteron::blocks
