// Decides the block "slew_limit": a follower of limited rate without modes, so that recordings that move in straight
// lines between rows are followed exactly, row by row. Does not decide its law: models/continuous/rate_limiter.h.
#pragma once

#include "engine/block/block.h"
#include "models/continuous/rate_limiter.h"

namespace hysteron::blocks {

struct SlewLimit {
  enum Parameter { rate, rise, fall, time };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static rate_limiter::Params<T> law(const View<T>& v) {
    const auto of_way = [&](int own) { return value_of(v.parameter(own)) > 0 ? v.parameter(own) : v.parameter(rate); };
    return {of_way(rise), of_way(fall), v.parameter(time)};
  }
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = v.x[0];
  }
  template <class T>
  static void derivative(const View<T>& v) {
    using std::max;
    using std::min;
    const auto p = law(v);
    const T asked = rate_limiter::asked(p, v.x[0], v.u[0]);
    if (v.sides != nullptr)
      v.out[0] = v.sides[0] > 0 ? p.rise : v.sides[1] < 0 ? T{-p.fall} : asked;
    else
      v.out[0] = max(T{-p.fall}, min(p.rise, asked));
  }
  static void kinks(const View<double>& v) {
    const auto p = law(v);
    const double asked = rate_limiter::asked(p, v.x[0], v.u[0]);
    v.out[0] = asked - p.rise;
    v.out[1] = asked + p.fall;
  }
  static void rest(const View<double>& v) { v.out[0] = v.u[0]; }
  static void rows(const RowsView& r);
};

Kernel slew_limit_block();

}  // namespace hysteron::blocks
