// Decides the value of a table between its knots, along one axis or several. Does not decide what is refused outside.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

#include "models/math/akima.h"
#include "models/number.h"

namespace hysteron::lookup {

enum class Between { linear, akima, monotone };
enum class Outside { clip, extrapolate, refuse };

inline constexpr int most_axes = 4;

/// Knots of one axis, strictly increasing, and where in them the input is.
template <class T>
struct Axis {
  std::span<const T> knots;
  T u{};
};

/// The interval in which u lies: knots[i] <= u < knots[i + 1], the first or the last where u lies outside.
template <class T>
std::size_t interval(std::span<const T> knots, double u) {
  const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, u,
                                      [](double value, const T& knot) { return value < plain(knot); });
  return static_cast<std::size_t>(above - knots.begin()) - 1;
}

/// Slope at a knot of a curve that is monotone wherever its values are: zero at their extrema, else the weighted
/// harmonic mean of the secants before and behind (intervals of length h0, h1). Source: Fritsch, Butland, SIAM J. Sci.
/// Stat. Comput. 5 (1984) 300-304.
template <class T>
T monotone_slope(const T& m0, const T& m1, const T& h0, const T& h1) {
  if (!(plain(m0) * plain(m1) > 0)) return T(0.0);
  const T w0 = 2.0 * h1 + h0, w1 = h1 + 2.0 * h0;
  return (w0 + w1) / (w0 / m0 + w1 / m1);
}

/// At the first or last knot: of the parabola through three knots, held where the curve would turn before the next.
/// Source: Moler, Numerical Computing with Matlab (2004), section 3.6, pchipend.
template <class T>
T monotone_end_slope(const T& m0, const T& m1, const T& h0, const T& h1) {
  const T d = ((2.0 * h0 + h1) * m0 - h0 * m1) / (h0 + h1);
  if (!(plain(d) * plain(m0) > 0)) return T(0.0);
  if (plain(m0) * plain(m1) < 0 && std::abs(plain(d)) > 3 * std::abs(plain(m0))) return 3.0 * m0;
  return d;
}

/// Value along one axis; y(i) is the value at knot i. Beyond the ends straight on, with the slope there.
template <class T, class Values>
T along(Between between, const Axis<T>& axis, const Values& y) {
  const auto& x = axis.knots;
  const std::size_t n = x.size(), i = interval(x, plain(axis.u));
  const auto length = [&](std::size_t k) { return T{x[k + 1] - x[k]}; };
  const auto secant = [&](std::size_t k) { return T{(y(k + 1) - y(k)) / length(k)}; };
  if (between == Between::linear || n == 2) return y(i) + (axis.u - x[i]) * secant(i);
  const auto slope = [&](std::size_t k) {  // at an end, or of the monotone curve anywhere
    const std::size_t own = k == 0 ? 0 : n - 2, next = k == 0 ? 1 : n - 3;
    if (k > 0 && k < n - 1) return monotone_slope(secant(k - 1), secant(k), length(k - 1), length(k));
    if (between == Between::monotone) return monotone_end_slope(secant(own), secant(next), length(own), length(next));
    return T{1.5 * secant(own) - 0.5 * secant(next)};  // Akima's, with secants that go on evenly
  };
  if (plain(axis.u) < plain(x.front())) return y(0) + slope(0) * (axis.u - x.front());
  if (plain(axis.u) > plain(x.back())) return y(n - 1) + slope(n - 1) * (axis.u - x.back());
  if (between == Between::monotone)
    return akima::cubic(y(i), y(i + 1), slope(i), slope(i + 1), length(i), T{axis.u - x[i]});
  const auto at = [](std::ptrdiff_t k) { return static_cast<std::size_t>(k); };
  return akima::on_piece(
      static_cast<std::ptrdiff_t>(n), static_cast<std::ptrdiff_t>(i), axis.u,
      [&](std::ptrdiff_t k) { return x[at(k)]; }, [&](std::ptrdiff_t k) { return y(at(k)); });
}

template <class T>
T inside_of(const Axis<T>& axis) {
  using std::max;
  using std::min;
  return max(min(axis.u, axis.knots.back()), axis.knots.front());
}

template <class T>
T at_axes(Between between, std::span<const Axis<T>> axes, std::span<const T> values) {
  const std::size_t below = values.size() / axes.front().knots.size();
  return along(between, axes.front(), [&](std::size_t i) -> T {
    const auto part = values.subspan(i * below, below);
    if (axes.size() == 1) return part.front();
    return at_axes(between, axes.subspan(1), part);
  });
}

/// The value of the table: values[i_1][i_2]... one behind the other, the last axis fastest. Not a number where one
/// input lies outside and Outside::refuse.
template <class T>
T value(Between between, Outside outside, std::span<Axis<T>> axes, std::span<const T> values) {
  for (auto& axis : axes) {
    const bool is_outside = plain(axis.u) < plain(axis.knots.front()) || plain(axis.u) > plain(axis.knots.back());
    if (is_outside && outside == Outside::refuse) return T(std::numeric_limits<double>::quiet_NaN());
    if (outside == Outside::clip) axis.u = inside_of(axis);
  }
  return at_axes(between, std::span<const Axis<T>>(axes), values);
}

/// A number that changes its sign at every knot where a straight piece ends: sin(pi s) between two knots, with the
/// other sign in every second interval. Beyond the ends, and in the outer intervals, so that it crosses zero at the
/// outermost knots only if `ends` bend.
inline double knot_kink(const Axis<double>& axis, bool ends) {
  const auto& x = axis.knots;
  const std::size_t i = interval(x, axis.u), last = x.size() - 2;
  const double s = (axis.u - x[i]) / (x[i + 1] - x[i]), sign = i % 2 == 0 ? 1 : -1;
  if (ends) return sign * (s < 0 ? s : s > 1 ? 1 - s : std::sin(std::numbers::pi * s));
  if (last == 0) return 1;
  return sign * (i == 0 ? 1 - s : i == last ? s : std::sin(std::numbers::pi * s));
}

}  // namespace hysteron::lookup
