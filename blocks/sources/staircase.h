// Decides the block "staircase": levels of equal duration. Does not decide how fast a real amplifier moves between
// them.
#pragma once

#include "engine/block/block.h"
#include "models/sources/signals.h"

namespace hysteron::blocks {

struct Staircase {
  static constexpr bool uses_time = true;
  enum Parameter { levels, duration };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    const auto level = v.list(levels);
    const double k =
        signals::staircase_piece(value_of(v.parameter(duration)), static_cast<double>(level.size()), v.branch);
    v.out[0] = level[static_cast<std::size_t>(k)];
  }
  static double next_breakpoint(const View<double>& v) {
    return signals::staircase_next_breakpoint(v.parameter(duration), static_cast<double>(v.list(levels).size()), v.t);
  }
};

Kernel staircase_block();

}  // namespace hysteron::blocks
