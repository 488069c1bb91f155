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
/// Source: Dormand, Prince, J. Comput. Appl. Math. 6 (1980) 19-26.
template <class T, class Slope>
T follow(Slope slope, const T& start, double relative = tolerance) {
  constexpr double shortest = 1e-13;  // of the path: a kink is crossed, whatever the estimate says
  T x = start;
  T k1 = slope(0.0, x);
  double s = 0, h = 1;
  for (int step = 0; step < most_steps; ++step) {
    h = std::min(h, 1 - s);
    const T w{h};
    const T k2 = slope(s + h / 5, T{x + w * (T{1.0 / 5} * k1)});
    const T k3 = slope(s + h * 3 / 10, T{x + w * (T{3.0 / 40} * k1 + T{9.0 / 40} * k2)});
    const T k4 = slope(s + h * 4 / 5, T{x + w * (T{44.0 / 45} * k1 - T{56.0 / 15} * k2 + T{32.0 / 9} * k3)});
    const T k5 = slope(s + h * 8 / 9, T{x + w * (T{19372.0 / 6561} * k1 - T{25360.0 / 2187} * k2 +
                                                 T{64448.0 / 6561} * k3 - T{212.0 / 729} * k4)});
    const T k6 = slope(s + h, T{x + w * (T{9017.0 / 3168} * k1 - T{355.0 / 33} * k2 + T{46732.0 / 5247} * k3 +
                                         T{49.0 / 176} * k4 - T{5103.0 / 18656} * k5)});
    const T to = x + w * (T{35.0 / 384} * k1 + T{500.0 / 1113} * k3 + T{125.0 / 192} * k4 - T{2187.0 / 6784} * k5 +
                          T{11.0 / 84} * k6);
    const T k7 = slope(s + h, to);
    const double error = std::fabs(71.0 / 57600 * plain(k1) - 71.0 / 16695 * plain(k3) + 71.0 / 1920 * plain(k4) -
                                   17253.0 / 339200 * plain(k5) + 22.0 / 525 * plain(k6) - plain(k7) / 40);
    const double steepest = std::max({std::fabs(plain(k1)), std::fabs(plain(k3)), std::fabs(plain(k4)),
                                      std::fabs(plain(k5)), std::fabs(plain(k6)), std::fabs(plain(k7))});
    const double admitted = relative * steepest + 4 * std::numeric_limits<double>::epsilon() * std::fabs(plain(to)) / h;
    const bool counts = std::isfinite(error) && std::isfinite(plain(to));
    if (counts && (error <= admitted || h <= shortest)) {
      if (h >= 1 - s) return to;
      s += h;
      x = to;
      k1 = k7;
    } else if (h <= shortest) {
      break;
    }
    const double factor = !counts ? 0.1 : error > 0 ? 0.9 * std::pow(admitted / error, 0.2) : 5;
    h *= std::clamp(factor, 0.1, 5.0);
  }
  return T{std::numeric_limits<double>::quiet_NaN()};
}

}  // namespace hysteron::path
