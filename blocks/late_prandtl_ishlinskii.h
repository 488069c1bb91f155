// Decides the block "late_prandtl_ishlinskii": play operators whose hysteretic part follows late. Does not decide the
// laws: models/prandtl_ishlinskii.h, models/late_hysteresis.h.
#pragma once

#include <span>
#include <string>

#include "blocks/prandtl_ishlinskii.h"
#include "engine/block.h"
#include "models/late_hysteresis.h"
#include "models/play.h"

namespace hysteron::blocks {

struct LatePrandtlIshlinskii {
  enum Parameter { thresholds, weights, sides, before, time, share, part };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);

  template <class T>
  static play::Sides sides_of(const View<T>& v) {
    return v.choice(sides) == 0 ? play::Sides::one : play::Sides::two;
  }
  /// What comes late, for operators as they stand: those with a threshold, or how far they are behind the input.
  template <class T, class Operator>
  static T late_part(const View<T>& v, const T& u, const Operator& operator_at) {
    const auto r = v.list(thresholds), c = v.list(weights);
    const bool whole = v.choice(part) == 0;
    T sum{0};
    for (std::size_t i = 0; i < r.size(); ++i)
      if (value_of(r[i]) > 0) sum += c[i] * (whole ? T{operator_at(i)} : T{operator_at(i) - u});
    return sum;
  }
  template <class T>
  static void advance(const View<T>& v) {
    prandtl_ishlinskii::advance(sides_of(v), v.list(thresholds), v.memory(), v.u[0], v.out);
  }
  template <class T>
  static void output(const View<T>& v) {
    const T now = late_part(v, v.u[0], [&](std::size_t i) { return v.m[i]; });
    v.out[0] = prandtl_ishlinskii::output(v.list(weights), v.memory()) - v.parameter(share) * (now - v.x[0]);
  }
  /// What the late part tends to: the operators of the last accepted point (before the first: of the start), moved on
  /// to the present input.
  template <class T>
  static T target(const View<T>& v) {
    const auto r = v.list(thresholds);
    return late_part(v, v.u[0], [&](std::size_t i) {
      const T accepted = v.m != nullptr ? v.m[i] : play::follow(sides_of(v), r[i], T{0}, v.parameter(before));
      return play::follow(sides_of(v), r[i], accepted, v.u[0]);
    });
  }
  template <class T>
  static void derivative(const View<T>& v) {
    v.out[0] = (target(v) - v.x[0]) / v.parameter(time);
  }
  static void rest(const View<double>& v) { v.out[0] = target(v); }
  static void rows(const RowsView& r);
  static void initial_memory(const View<double>& v);
  static std::string check_memory(const View<double>& v);
};

Kernel late_prandtl_ishlinskii_block();

}  // namespace hysteron::blocks
