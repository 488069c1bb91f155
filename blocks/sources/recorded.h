// Decides the blocks "recorded" and "input": signals that come as samples. Does not decide how samples are joined
// (engine/diagram/series.h) nor where they come from (io).
#pragma once

#include <limits>
#include <type_traits>

#include "engine/block/block.h"

namespace hysteron::blocks {

/// What both have in common: the series at the time, on the piece that holds the branch.
struct SeriesBlock {
  static constexpr bool uses_time = true;
  static Sizes sizes(const Shape&) {
    Sizes s;
    s.feedthrough = false;  // how smooth it is, the engine reads from the series
    return s;
  }
  template <class T>
  static void output(const View<T>& v) {
    if (v.series == nullptr) {  // the engine asks for the series before it runs; nothing else may be taken for a value
      v.out[0] = T{std::numeric_limits<double>::quiet_NaN()};
      return;
    }
    const double value = v.series->value(value_of(v.t), v.branch);
    if constexpr (requires { v.t.rate; })
      v.out[0] = {value, v.series->slope(v.branch) * v.t.rate};
    else
      v.out[0] = value;
  }
  static double next_breakpoint(const View<double>& v) {
    return v.series == nullptr ? std::numeric_limits<double>::infinity() : v.series->next_breakpoint(v.t);
  }
  // No pace: every sample is a corner, at which a solver stops anyway, and between two of them nothing turns back.
};

struct Recorded : SeriesBlock {
  static void describe(Declaration& d);
};
struct Input : SeriesBlock {
  static void describe(Declaration& d);
};

Kernel recorded_block();
Kernel input_block();

}  // namespace hysteron::blocks
