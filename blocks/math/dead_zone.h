// Decides the blocks "dead_zone" and "wrap": what a zone swallows, and angles within one turn.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/block/block.h"
#include "models/math/saturation.h"

namespace hysteron::blocks {

struct DeadZone {
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
  static void describe(BlockSpec<DeadZone>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    return {in.u - saturation::limit(p.lower, p.upper, in.u)};
  }
  static std::array<double, 2> kinks(const Params<double>& p, const In<double>& in) {
    return {in.u - p.lower, in.u - p.upper};
  }
  static std::string check(const Params<double>& p);
};

struct Wrap {
  template <class T>
  struct Params {
    T period, lower;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Wrap>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    const double turns = std::floor(value_of(T{(in.u - p.lower) / p.period}));
    return {in.u - T{turns} * p.period};
  }
  /// Zero where it jumps.
  static std::array<double, 1> kinks(const Params<double>& p, const In<double>& in) {
    return {std::sin(std::numbers::pi * (in.u - p.lower) / p.period)};
  }
};

Kernel dead_zone_block();
Kernel wrap_block();

}  // namespace hysteron::blocks
