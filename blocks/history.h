// Decides what a remembered signal was at a time between its accepted points. Does not decide what is remembered: the
// engine.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/kernel.h"

namespace hysteron::blocks {

/// Value of the history at `time`, on the interval that holds `branch`: cubic Hermite where both ends have a rate, else
/// linear; constant before the first point; behind the last one straight on with its rate. A time that stands twice is
/// a jump or a corner: the second one counts from there on.
template <class T>
T history_value(const History& h, const T& time, double branch) {
  const std::size_t n = h.t.size();
  if (n <= h.first || branch < h.t[h.first]) return T{h.before};
  const auto from = h.t.begin() + static_cast<std::ptrdiff_t>(h.first);
  const auto k = static_cast<std::size_t>(std::upper_bound(from, h.t.end(), branch) - h.t.begin()) - 1;
  const T since = time - T{h.t[k]};
  if (k + 1 == n) return std::isnan(h.rate[k]) ? T{h.u[k]} : T{h.u[k]} + T{h.rate[k]} * since;
  const double step = h.t[k + 1] - h.t[k];
  const double rise = h.u[k + 1] - h.u[k];
  const T s = since / T{step};
  if (std::isnan(h.rate[k]) || std::isnan(h.rate[k + 1])) return T{h.u[k]} + T{rise} * s;
  // u(s) = u_k + s (a + s (b + s c)) with the slopes a at the left and the given one at the right.
  const double a = h.rate[k] * step;
  const double b = 3 * rise - 2 * a - h.rate[k + 1] * step;
  const double c = a + h.rate[k + 1] * step - 2 * rise;
  return T{h.u[k]} + s * (T{a} + s * (T{b} + s * T{c}));
}

}  // namespace hysteron::blocks
