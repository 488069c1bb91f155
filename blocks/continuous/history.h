// Decides what a remembered signal was at a time between its accepted points. Does not decide what is remembered: the
// engine.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/block/kernel.h"

namespace hysteron::blocks {

/// Value of the history at `time`: cubic Hermite where both ends of its interval have a rate, else linear; constant
/// before the first point; behind the last one straight on with its rate. A time that stands twice is a jump or a
/// corner: there `branch`, a time inside the present smooth piece, tells on which side we are, since `time` is rounded.
template <class T>
T history_value(const History& h, const T& time, double branch) {
  const std::size_t n = h.t.size();
  if (n <= h.first) return T{h.before};
  const double at = value_of(time);
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * std::max(std::abs(at), std::abs(h.t.back()));
  const auto from = h.t.begin() + static_cast<std::ptrdiff_t>(h.first);
  auto next = static_cast<std::size_t>(std::upper_bound(from, h.t.end(), at) - h.t.begin());
  if (next > h.first && at - h.t[next - 1] <= rounding && branch < h.t[next - 1]) {
    const double here = h.t[next - 1];
    while (next > h.first && h.t[next - 1] >= here) --next;
  } else if (next < n && h.t[next] - at <= rounding && branch >= h.t[next]) {
    const double here = h.t[next];
    while (next < n && h.t[next] <= here) ++next;
  }
  if (next == h.first) return T{h.before};
  const std::size_t k = next - 1;
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
