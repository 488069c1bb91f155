// Decides the blocks "compare" and "comparator": whether one signal is above another, or above a level.
// Without hysteresis: with it, "relay".
#pragma once

#include <array>

#include "engine/block/block.h"
#include "models/logic/logic.h"

namespace hysteron::blocks {

struct Compare {
  static constexpr Smoothness smoothness = Smoothness::jumps;
  template <class T>
  struct Params {
    T is;
  };
  template <class T>
  struct In {
    T a, b;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Compare>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    return {logic::truth<T>(logic::holds(logic::Relation(static_cast<int>(plain(p.is))), in.a, in.b))};
  }
  static std::array<double, 1> kinks(const Params<double>&, const In<double>& in) { return {in.a - in.b}; }
};

struct Comparator {
  static constexpr Smoothness smoothness = Smoothness::jumps;
  template <class T>
  struct Params {
    T level, above, below;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Comparator>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    return {in.u > p.level ? p.above : p.below};
  }
  static std::array<double, 1> kinks(const Params<double>& p, const In<double>& in) { return {in.u - p.level}; }
};

Kernel compare_block();
Kernel comparator_block();

}  // namespace hysteron::blocks
