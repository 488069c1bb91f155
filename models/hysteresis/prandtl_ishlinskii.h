// Decides the Prandtl-Ishlinskii model: a weighted sum of play operators, and the closed forms of its loop from rest.
// Does not invert it and does not identify it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "models/hysteresis/play.h"

namespace hysteron::prandtl_ishlinskii {

/// Moves every operator from its memory to the input u: after[i] = play(thresholds[i], before[i], u).
template <class T>
void advance(play::Sides sides, std::span<const T> thresholds, std::span<const T> before, const T& u, T* after) {
  const std::size_t n = thresholds.size();
  if (sides == play::Sides::two)
    for (std::size_t i = 0; i < n; ++i) after[i] = play::follow(thresholds[i], before[i], u);
  else
    for (std::size_t i = 0; i < n; ++i) after[i] = play::follow_one_sided(thresholds[i], before[i], u);
}

/// y = sum c_i w_i over advanced operators; threshold 0 is the linear part, since its w is u.
/// Source: thesis Eq. 2.5; Kuhnen, Eur. J. Control 9 (2003) 407-418.
template <class T>
T output(std::span<const T> weights, std::span<const T> operators) {
  T y{0};
  for (std::size_t i = 0; i < weights.size(); ++i) y += weights[i] * operators[i];
  return y;
}

/// The first operator whose memory, together with that of the next, no input could have left behind; the number of
/// operators if there is none: 0 <= w_i - w_(i+1) <= r_(i+1) - r_i (one side), |w_i - w_(i+1)| <= r_(i+1) - r_i (two).
/// `slack` [u] forgives rounding. Source: thesis section 2.1 (nested states).
inline std::size_t nested_until(play::Sides sides, std::span<const double> thresholds, std::span<const double> memory,
                                double slack) {
  for (std::size_t i = 0; i + 1 < memory.size(); ++i) {
    const double step = memory[i] - memory[i + 1], most = thresholds[i + 1] - thresholds[i];
    if (step > most + slack || step < (sides == play::Sides::one ? 0 : -most) - slack) return i;
  }
  return memory.size();
}

/// So many operators pass the rows together, in registers.
inline constexpr std::size_t group = 16;

namespace detail {

/// One group over all rows: its operators stay in registers. Weight 0 fills up an odd number. Adds to y but for the
/// first group.
template <std::size_t size, play::Sides sides>
void pass_rows(std::size_t n, const double* thresholds, const double* weights, double* operators, const double* u,
               double* y, std::ptrdiff_t stride, std::ptrdiff_t rows, bool first) {
  std::array<double, size> r{}, c{}, w{};
  std::copy_n(thresholds, n, r.begin());
  std::copy_n(weights, n, c.begin());
  std::copy_n(operators, n, w.begin());
  for (std::ptrdiff_t k = 0; k < rows; ++k) {
    const double now = u[k * stride];
    for (std::size_t i = 0; i < size; ++i) w[i] = play::follow(sides, r[i], w[i], now);
    std::array<double, 2> sum{};
    for (std::size_t i = 0; i < size; i += 2)
      for (std::size_t j = 0; j < 2; ++j) sum[j] += c[i + j] * w[i + j];
    const double whole = sum[0] + sum[1];
    y[k * stride] = first ? whole : y[k * stride] + whole;
  }
  std::copy_n(w.begin(), n, operators);
}

template <std::size_t size, play::Sides sides>
void pass_group(std::size_t n, const double* thresholds, const double* weights, double* operators, const double* u,
                double* y, std::ptrdiff_t stride, std::ptrdiff_t rows, bool first) {
  if constexpr (size > 2)
    if (n <= size - 2) return pass_group<size - 2, sides>(n, thresholds, weights, operators, u, y, stride, rows, first);
  pass_rows<size, sides>(n, thresholds, weights, operators, u, y, stride, rows, first);
}

}  // namespace detail

/// advance() and output() for many rows of the input, one behind the other: y[k * stride] for u[k * stride], group
/// after group of operators, those at even and odd places summed side by side. The same numbers but for rounding.
/// Operators of weight zero, which nobody sees, are left where they are: a fit asks for the response to one weight
/// after the other.
inline void pass(play::Sides sides, std::span<const double> thresholds, std::span<const double> weights,
                 double* operators, const double* u, double* y, std::ptrdiff_t stride, std::ptrdiff_t rows) {
  const auto one = sides == play::Sides::two ? &detail::pass_group<group, play::Sides::two>
                                             : &detail::pass_group<group, play::Sides::one>;
  std::array<double, group> r, c, w;
  std::array<std::size_t, group> place;
  bool first = true;
  for (std::size_t next = 0; next < weights.size();) {
    std::size_t n = 0;
    for (; next < weights.size() && n < group; ++next) {
      if (weights[next] == 0) continue;
      r[n] = thresholds[next];
      c[n] = weights[next];
      w[n] = operators[next];
      place[n++] = next;
    }
    if (n == 0 && !first) break;
    one(n, r.data(), c.data(), w.data(), u, y, stride, rows, first);
    first = false;
    for (std::size_t i = 0; i < n; ++i) operators[place[i]] = w[i];
  }
}

/// Output at the top of a loop 0 .. top from rest, one-sided operators: H(U) = sum c_i max(U - r_i, 0). Thesis
/// section 2.1.
template <class T>
T stroke(std::span<const T> thresholds, std::span<const T> weights, const T& top) {
  using std::max;
  T h{0};
  for (std::size_t i = 0; i < weights.size(); ++i) h += weights[i] * max(top - thresholds[i], T{0});
  return h;
}

/// Area of the loop 0 .. top .. 0 from rest, one-sided operators: sum c_i r_i max(U - r_i, 0). Thesis section 2.1.
template <class T>
T loop_area(std::span<const T> thresholds, std::span<const T> weights, const T& top) {
  using std::max;
  T area{0};
  for (std::size_t i = 0; i < weights.size(); ++i) area += weights[i] * thresholds[i] * max(top - thresholds[i], T{0});
  return area;
}

}  // namespace hysteron::prandtl_ishlinskii
