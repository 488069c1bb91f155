// Decides what a converter of limited resolution makes of a signal. Does not decide when it converts.
#pragma once

#include <algorithm>
#include <cmath>

#include "models/number.h"

namespace hysteron::quantizer {

/// Size of one step: (upper - lower)/2^bits; 16 bit, +-10 V: 305.2 uV.
template <class T>
T step(const T& bits, const T& lower, const T& upper) {
  return (upper - lower) / T{std::exp2(plain(bits))};
}

/// The nearest of the 2^bits levels lower, lower + q ... upper - q (two's complement: the upper end itself is not
/// among them, zero of a symmetric range is). Half a step up. Error at most q/2 inside the range.
/// Source: Widrow, Kollar, Quantization Noise (2008).
template <class T>
T quantize(const T& bits, const T& lower, const T& upper, const T& u) {
  using std::floor;
  using std::max;
  using std::min;
  const T q = step(bits, lower, upper);
  const T code = floor(T{(u - lower) / q + T{0.5}});
  return lower + q * max(T{0}, min(T{std::exp2(plain(bits)) - 1}, code));
}

}  // namespace hysteron::quantizer
