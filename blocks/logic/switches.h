// Decides the blocks "switch" and "manual_switch": which of two signals goes on.
#pragma once

#include <array>

#include "engine/block/block.h"
#include "models/number.h"

namespace hysteron::blocks {

struct Switch {
  static constexpr Smoothness smoothness = Smoothness::jumps;
  template <class T>
  struct Params {
    T level;
  };
  template <class T>
  struct In {
    T above, control, below;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Switch>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    return {in.control > p.level ? in.above : in.below};
  }
  static std::array<double, 1> kinks(const Params<double>& p, const In<double>& in) { return {in.control - p.level}; }
};

struct ManualSwitch {
  template <class T>
  struct Params {
    T position;
  };
  template <class T>
  struct In {
    T first, second;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<ManualSwitch>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    return {plain(p.position) == 0 ? in.first : in.second};
  }
};

Kernel switch_block();
Kernel manual_switch_block();

}  // namespace hysteron::blocks
