// Decides the input shaper ZV: two steps in place of one, of which the second takes back what the first has set
// swinging. Does not delay anything.
#pragma once

#include <cmath>

namespace hysteron::input_shaper {

/// The output is first u(t) + (1 - first) u(t - delay).
template <class T>
struct Shape {
  T first{};  ///< [-]
  T delay{};  ///< [s]
};

/// Half a damped period of a mode of `frequency` [Hz] (undamped) and damping z < 1: a mode that was struck by a step of
/// 1/(1 + K), K = exp(-pi z/sqrt(1 - z^2)), has then swung to K/(1 + K) beyond it, and the second step of that size
/// stops it there. Source: Singer, Seering, J. Dyn. Syst. Meas. Control 112 (1990) 76-82.
template <class T>
Shape<T> zv(const T& frequency, const T& damping) {
  using std::exp;
  using std::sqrt;
  const T root = sqrt(T{1} - damping * damping);
  const T overshoot = exp(T{-3.141592653589793238462643 * damping / root});
  return {T{1} / (T{1} + overshoot), T{0.5} / (frequency * root)};
}

}  // namespace hysteron::input_shaper
