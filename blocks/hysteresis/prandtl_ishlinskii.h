// Decides the block "prandtl_ishlinskii": a weighted sum of play operators. Does not decide its law: models/.
#pragma once

#include <algorithm>
#include <span>
#include <string>

#include "engine/block/block.h"
#include "models/hysteresis/prandtl_ishlinskii.h"

namespace hysteron::blocks {

struct PrandtlIshlinskii {
  enum Parameter { thresholds, weights, sides, before };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static play::Sides sides_of(const View<T>& v) {
    return v.choice(sides) == 0 ? play::Sides::one : play::Sides::two;
  }
  template <class T>
  static void advance(const View<T>& v) {
    prandtl_ishlinskii::advance(sides_of(v), v.list(thresholds), v.memory(), v.u[0], v.out);
  }
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = prandtl_ishlinskii::output(v.list(weights), v.memory());
  }
  static void rows(const RowsView& r) {
    for (int lane = 0; lane < r.lanes; ++lane) {
      const View<double>& v = r.views[lane];
      prandtl_ishlinskii::pass(sides_of(v), v.list(thresholds), v.list(weights), r.m + lane * v.n_m, r.u[0] + lane,
                               r.y[0] + lane, r.lanes, r.count);
    }
  }
  static void initial_memory(const View<double>& v);
  static std::string check_memory(const View<double>& v);
};

/// "" or which numbers cannot stand side by side in the memory of such operators.
std::string check_nested(play::Sides sides, std::span<const double> thresholds, std::span<const double> memory);

Kernel prandtl_ishlinskii_block();

}  // namespace hysteron::blocks
