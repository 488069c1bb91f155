// Decides the static curve of a polynomial between two limits and straight on beyond them. Does not fit it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace hysteron::polynomial {

/// c_0 + c_1 x + c_2 x^2 + ... and its slope in x, by Horner's rule.
template <class T>
struct Curve {
  T value, slope;
};
template <class T>
Curve<T> at(std::span<const T> coefficients, const T& x) {
  Curve<T> y{T{0}, T{0}};
  for (std::size_t k = coefficients.size(); k-- > 0;) {
    y.slope = y.slope * x + y.value;
    y.value = y.value * x + coefficients[k];
  }
  return y;
}

/// The polynomial of (u - about)/reference for lower <= u <= upper, its tangents at the limits beyond: value and slope
/// are continuous. u, about, reference, lower and upper in one unit; limits may be infinite.
template <class T>
T continued(std::span<const T> coefficients, const T& about, const T& reference, const T& lower, const T& upper,
            const T& u) {
  using std::max;
  using std::min;
  const T inside = max(min(u, upper), lower);
  const Curve<T> y = at(coefficients, T{(inside - about) / reference});
  return y.value + y.slope * ((u - inside) / reference);
}

}  // namespace hysteron::polynomial
