// Decides weighted sums over the last samples. Does not decide when samples come; the line of past ones is that of
// delay_line.h.
#pragma once

#include <cstddef>
#include <span>

namespace hysteron::fir {

/// y_k = b_0 u_k + b_1 u_(k-1) + ...; the line holds u_(k-n+1) ... u_(k-1), the oldest first.
/// Source: Oppenheim, Schafer, Discrete-Time Signal Processing, 3rd ed. (2010), section 6.5.
template <class T>
T output(std::span<const T> coefficients, std::span<const T> line, const T& u) {
  T y = coefficients[0] * u;
  for (std::size_t i = 0; i < line.size(); ++i) y += coefficients[line.size() - i] * line[i];
  return y;
}

/// Mean of the line and the present sample. Summed anew at each sample: no error is carried on.
template <class T>
T mean(std::span<const T> line, const T& u) {
  T sum = u;
  for (const T& past : line) sum += past;
  return sum / T(static_cast<double>(line.size() + 1));
}

}  // namespace hysteron::fir
