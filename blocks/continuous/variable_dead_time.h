// Decides the block "variable_dead_time": its input, as long ago as another signal says. Does not remember it: the
// engine keeps the history of its first input.
#pragma once

#include <algorithm>
#include <limits>

#include "blocks/continuous/history.h"
#include "engine/block/block.h"

namespace hysteron::blocks {

struct VariableDeadTime {
  static constexpr bool uses_time = true;
  enum Parameter { longest };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape&);
  template <class T>
  static void output(const View<T>& v) {
    using std::max;
    using std::min;
    const T late = max(T{0}, min(v.parameter(longest), v.u[1]));
    v.out[0] = v.history == nullptr ? T{std::numeric_limits<double>::quiet_NaN()}
                                    : history_value(*v.history, T{v.t - late}, v.branch - value_of(late));
  }
  static void kinks(const View<double>& v) {
    v.out[0] = v.u[1];
    v.out[1] = v.u[1] - v.parameter(longest);
  }
  static double reach_back(const View<double>& v) { return v.parameter(longest); }
};

Kernel variable_dead_time_block();

}  // namespace hysteron::blocks
