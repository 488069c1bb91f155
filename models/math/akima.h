// Decides the slopes of Akima's curve through points: a cubic between each two, whose slopes hang on two neighbours to
// each side, so that one outlier bends no more than its surroundings. Does not find the piece that holds a place.
#pragma once

#include <cmath>
#include <cstddef>

#include "models/number.h"

namespace hysteron::akima {

/// Slope at a point from the four secants around it, two before and two behind. Where both pairs are straight, their
/// mean. Source: Akima, J. ACM 17 (1970) 589-602, Eq. 1.
template <class T>
T slope(const T& m1, const T& m2, const T& m3, const T& m4) {
  using std::abs;
  const T before = abs(T{m2 - m1}), behind = abs(T{m4 - m3}), both = before + behind;
  if (!(plain(both) > 0)) return T{0.5} * (m2 + m3);
  return (behind * m2 + before * m3) / both;
}

/// Value on the cubic from (0, y0) to (width, y1) with these slopes at its ends, `along` from 0 to width.
template <class T>
T cubic(const T& y0, const T& y1, const T& slope0, const T& slope1, const T& width, const T& along) {
  const T s = along / width;
  const T a = slope0 * width, rise = y1 - y0;
  const T b = T{3} * rise - T{2} * a - slope1 * width, c = a + slope1 * width - T{2} * rise;
  return y0 + s * (a + s * (b + s * c));
}

/// Value at x on piece k of the curve through (at(i), value(i)), i = 0 .. n - 1, n >= 2; 0 <= k <= n - 2. Beyond the
/// ends secants go on evenly (the same source, Eq. 9). `at` and `value` give T.
template <class T, class At, class Value>
T on_piece(std::ptrdiff_t n, std::ptrdiff_t k, const T& x, const At& at, const Value& value) {
  const auto inside = [&](std::ptrdiff_t i) { return T{(value(i + 1) - value(i)) / (at(i + 1) - at(i))}; };
  const auto secant = [&](std::ptrdiff_t i) {
    const std::ptrdiff_t last = n - 2;
    if (last == 0) return inside(0);
    if (i < 0) return T{inside(0) + T{static_cast<double>(-i)} * (inside(0) - inside(1))};
    if (i > last) return T{inside(last) + T{static_cast<double>(i - last)} * (inside(last) - inside(last - 1))};
    return inside(i);
  };
  const T m1 = secant(k - 2), m2 = secant(k - 1), m3 = secant(k), m4 = secant(k + 1), m5 = secant(k + 2);
  return cubic(value(k), value(k + 1), slope(m1, m2, m3, m4), slope(m2, m3, m4, m5), T{at(k + 1) - at(k)},
               T{x - at(k)});
}

}  // namespace hysteron::akima
