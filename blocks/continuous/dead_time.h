// Decides the block "dead_time": its input, some time ago. Does not remember it: the engine keeps the history.
#pragma once

#include <limits>

#include "blocks/continuous/history.h"
#include "engine/block/block.h"

namespace hysteron::blocks {

struct DeadTime {
  static constexpr bool uses_time = true;
  enum Parameter { delay };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape&);
  template <class T>
  static void output(const View<T>& v) {
    const T& late = v.parameter(delay);
    v.out[0] = v.history == nullptr ? T{std::numeric_limits<double>::quiet_NaN()}
                                    : history_value(*v.history, v.t - late, v.branch - value_of(late));
  }
  static double reach_back(const View<double>& v) { return v.parameter(delay); }
};

Kernel dead_time_block();

}  // namespace hysteron::blocks
