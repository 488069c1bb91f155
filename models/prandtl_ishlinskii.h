// Decides the Prandtl-Ishlinskii model: a weighted sum of play operators, and the closed forms of its loop from rest.
// Does not invert it and does not identify it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "models/play.h"

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
