// Decides the block "late_prandtl_ishlinskii": play operators whose hysteretic part follows late. Does not decide the
// laws: models/hysteresis/prandtl_ishlinskii.h, models/hysteresis/late_hysteresis.h.
#pragma once

#include <span>
#include <string>

#include "blocks/hysteresis/prandtl_ishlinskii.h"
#include "engine/block/block.h"
#include "models/hysteresis/late_hysteresis.h"
#include "models/hysteresis/play.h"

namespace hysteron::blocks {

struct LatePrandtlIshlinskii {
  enum Parameter { thresholds, weights, sides, before, time, share, ahead, spread };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);

  template <class T>
  static play::Sides sides_of(const View<T>& v) {
    return v.choice(sides) == 0 ? play::Sides::one : play::Sides::two;
  }
  /// Time constant of the operator i, which has a threshold.
  template <class T>
  static T time_of(const View<T>& v, std::size_t i) {
    using std::exp;
    using std::log;
    const auto r = v.list(thresholds);
    return v.parameter(time) * exp(v.parameter(spread) * log(r[i] / r.back()));
  }
  /// What of the operator i comes late, where it stands at w.
  template <class T>
  static T late_part(const View<T>& v, const T& w, const T& u) {
    return w - v.parameter(ahead) * u;
  }
  template <class T>
  static void advance(const View<T>& v) {
    prandtl_ishlinskii::advance(sides_of(v), v.list(thresholds), v.memory(), v.u[0], v.out);
  }
  template <class T>
  static void output(const View<T>& v) {
    const auto r = v.list(thresholds), c = v.list(weights);
    T y = prandtl_ishlinskii::output(c, v.memory());
    for (std::size_t i = 0; i < r.size(); ++i)
      if (value_of(r[i]) > 0) y -= v.parameter(share) * c[i] * (late_part(v, v.m[i], v.u[0]) - v.x[i]);
    v.out[0] = y;
  }
  /// What the late part of operator i tends to: from the last accepted point (before the first: from the start) moved
  /// on to the present input.
  template <class T>
  static T target(const View<T>& v, std::size_t i) {
    const T& r = v.list(thresholds)[i];
    const T accepted = v.m != nullptr ? v.m[i] : play::follow(sides_of(v), r, T{0}, v.parameter(before));
    return late_part(v, play::follow(sides_of(v), r, accepted, v.u[0]), v.u[0]);
  }
  template <class T>
  static void derivative(const View<T>& v) {
    const auto r = v.list(thresholds);
    for (std::size_t i = 0; i < r.size(); ++i)  // without a threshold nothing is late
      v.out[i] = value_of(r[i]) > 0 ? T{(target(v, i) - v.x[i]) / time_of(v, i)} : T{0};
  }
  static void rest(const View<double>& v) {
    for (std::size_t i = 0; i < v.list(thresholds).size(); ++i) v.out[i] = target(v, i);
  }
  static void rows(const RowsView& r);
  static void initial_memory(const View<double>& v);
  static std::string check_memory(const View<double>& v);
};

Kernel late_prandtl_ishlinskii_block();

}  // namespace hysteron::blocks
