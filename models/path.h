// Decides how a state follows a path on which time does not count: a move of the input of a rate-independent law.
// Does not know the law: the caller gives its slope.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "models/number.h"

namespace hysteron::path {

inline constexpr double tolerance = 1e-10;  ///< [-] of the length of the way, unless the caller wants another
inline constexpr int most_steps = 20000;    ///< beyond it the law has no solution on this path

/// x at s = 1 for dx/ds = slope(s, x), x(0) = start: Runge-Kutta 5(4) whose error on each step is below
/// `relative` times the way of x on that step (and below rounding of x, if that is more).
///
/// The derivative directions of T are carried along the same steps. Not a number where no step succeeds: the slope is
/// infinite, or has no value.
/// Source: Cash, Karp, ACM Trans. Math. Softw. 16 (1990) 201-222: six slopes, none beyond what one step needs.
template <class T, class Slope>
T follow(Slope slope, const T& start, double relative = tolerance) {
  constexpr double shortest = 1e-13;  // of the path: a kink is crossed, whatever the estimate says
  T x = start;
  double s = 0, h = 1;
  for (int step = 0; step < most_steps; ++step) {
    h = std::min(h, 1 - s);
    const T w{h};
    const T k1 = slope(s, x);
    const T k2 = slope(s + h / 5, T{x + w * (T{1.0 / 5} * k1)});
    const T k3 = slope(s + h * 3 / 10, T{x + w * (T{3.0 / 40} * k1 + T{9.0 / 40} * k2)});
    const T k4 = slope(s + h * 3 / 5, T{x + w * (T{3.0 / 10} * k1 - T{9.0 / 10} * k2 + T{6.0 / 5} * k3)});
    const T k5 = slope(s + h, T{x + w * (T{5.0 / 2} * k2 - T{11.0 / 54} * k1 - T{70.0 / 27} * k3 + T{35.0 / 27} * k4)});
    const T k6 = slope(s + h * 7 / 8, T{x + w * (T{1631.0 / 55296} * k1 + T{175.0 / 512} * k2 + T{575.0 / 13824} * k3 +
                                                 T{44275.0 / 110592} * k4 + T{253.0 / 4096} * k5)});
    const T to = x + w * (T{37.0 / 378} * k1 + T{250.0 / 621} * k3 + T{125.0 / 594} * k4 + T{512.0 / 1771} * k6);
    const double error = std::fabs(
        (37.0 / 378 - 2825.0 / 27648) * plain(k1) + (250.0 / 621 - 18575.0 / 48384) * plain(k3) +
        (125.0 / 594 - 13525.0 / 55296) * plain(k4) - 277.0 / 14336 * plain(k5) + (512.0 / 1771 - 1.0 / 4) * plain(k6));
    const double steepest = std::max(
        {std::fabs(plain(k1)), std::fabs(plain(k3)), std::fabs(plain(k4)), std::fabs(plain(k5)), std::fabs(plain(k6))});
    const double admitted = relative * steepest + 4 * std::numeric_limits<double>::epsilon() * std::fabs(plain(to)) / h;
    const bool counts = std::isfinite(error) && std::isfinite(plain(to));
    if (counts && (error <= admitted || h <= shortest)) {
      if (h >= 1 - s) return to;
      s += h;
      x = to;
    } else if (h <= shortest) {
      break;
    }
    const double factor = !counts ? 0.1 : error > 0 ? 0.9 * std::pow(admitted / error, 0.2) : 5;
    h *= std::clamp(factor, 0.1, 5.0);
  }
  return T{std::numeric_limits<double>::quiet_NaN()};
}

}  // namespace hysteron::path
