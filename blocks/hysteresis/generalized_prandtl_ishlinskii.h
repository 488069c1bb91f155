// Decides the block "generalized_prandtl_ishlinskii": play operators that follow a bent drive, beside a linear part.
// Does not decide its laws: models/hysteresis/curved_drive.h, models/hysteresis/prandtl_ishlinskii.h.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>

#include "engine/block/block.h"
#include "models/hysteresis/curved_drive.h"
#include "models/hysteresis/prandtl_ishlinskii.h"

namespace hysteron::blocks {

struct GeneralizedPrandtlIshlinskii {
  enum Parameter { thresholds, weights, sides, lower, upper, slope_at_lower, slope_at_upper, before };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static std::string check(const View<double>& v);
  static std::string check_memory(const View<double>& v);
  static void initial_memory(const View<double>& v);

  template <class T>
  static play::Sides sides_of(const View<T>& v) {
    return v.choice(sides) == 0 ? play::Sides::one : play::Sides::two;
  }
  template <class T>
  static T bent(const View<T>& v, const T& u) {
    const curved_drive::Params<T> curve{v.parameter(lower), v.parameter(upper), v.parameter(slope_at_lower),
                                        v.parameter(slope_at_upper)};
    return curved_drive::curved(curve, u);
  }
  /// Operators that follow the drive itself: the one of threshold 0, or none.
  template <class T>
  static std::size_t linear(const View<T>& v) {
    return v.list(thresholds)[0] == 0.0 ? 1 : 0;
  }
  template <class T>
  static void advance(const View<T>& v) {
    const std::size_t n = linear(v);
    if (n > 0) v.out[0] = v.u[0];
    prandtl_ishlinskii::advance(sides_of(v), v.list(thresholds).subspan(n), v.memory().subspan(n), bent(v, v.u[0]),
                                v.out + n);
  }
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = prandtl_ishlinskii::output(v.list(weights), v.memory());
  }
  static void rows(const RowsView& r) {
    for (int lane = 0; lane < r.lanes; ++lane) rows_of(r, lane);
  }

 private:
  static void rows_of(const RowsView& r, int lane) {
    constexpr std::ptrdiff_t at_once = 256;
    std::array<double, at_once> drive, sum;
    const View<double>& v = r.views[lane];
    const std::size_t n = linear(v);
    double* memory = r.m + lane * v.n_m;
    const double gain = n > 0 ? v.list(weights)[0] : 0;
    const double* u = r.u[0] + lane;
    double* y = r.y[0] + lane;
    for (std::ptrdiff_t first = 0; first < r.count; first += at_once) {
      const std::ptrdiff_t count = std::min<std::ptrdiff_t>(at_once, r.count - first);
      for (std::ptrdiff_t k = 0; k < count; ++k) drive[static_cast<std::size_t>(k)] = bent(v, u[(first + k) * r.lanes]);
      prandtl_ishlinskii::pass(sides_of(v), v.list(thresholds).subspan(n), v.list(weights).subspan(n), memory + n,
                               drive.data(), sum.data(), 1, count);
      for (std::ptrdiff_t k = 0; k < count; ++k)
        y[(first + k) * r.lanes] = sum[static_cast<std::size_t>(k)] + gain * u[(first + k) * r.lanes];
    }
    if (n > 0 && r.count > 0) memory[0] = u[(r.count - 1) * static_cast<std::ptrdiff_t>(r.lanes)];
  }
};

Kernel generalized_prandtl_ishlinskii_block();

}  // namespace hysteron::blocks
