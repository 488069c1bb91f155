// Decides what the mains adds to a signal: a line and its harmonics. Does not decide where it gets in.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace hysteron::mains {

/// sum_k cosine_k cos(2 pi k f t) + sine_k sin(2 pi k f t), k = 1, 2, ...; f [Hz], t [s], amplitudes in the unit of the
/// signal. Its mean square is half the sum of all squares.
template <class T>
T hum(const T& frequency, std::span<const T> cosine, std::span<const T> sine, const T& t) {
  using std::cos;
  using std::sin;
  const T angle = 2 * std::numbers::pi * frequency * t;
  const T c1 = cos(angle), s1 = sin(angle);
  T c = c1, s = s1, sum{0};  // of harmonic k: one turned on by the first angle is the next
  for (std::size_t k = 0; k < cosine.size(); ++k) {
    sum += cosine[k] * c + sine[k] * s;
    const T turned = c * c1 - s * s1;
    s = s * c1 + c * s1;
    c = turned;
  }
  return sum;
}

}  // namespace hysteron::mains
