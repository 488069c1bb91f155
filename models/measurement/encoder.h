// Decides what an encoder tells of a position: its counts, and the error of their interpolation. Does not sample.
#pragma once

#include <cmath>

#include "models/number.h"

namespace hysteron::encoder {

/// One harmonic of the error of the interpolation, which is periodic in the pitch of the scale: cosine cos(2 pi k
/// u/pitch) + sine sin(2 pi k u/pitch). Offsets of the two signals make k = 1, unequal amplitudes and a phase other
/// than 90 deg k = 2. Source: Heydemann, Applied Optics 20 (1981) 3382-3384.
template <class T>
T harmonic(int k, const T& cosine, const T& sine, const T& pitch, const T& u) {
  using std::cos;
  using std::sin;
  const T phase = 6.283185307179586476925287 * k * u / pitch;
  return cosine * cos(phase) + sine * sin(phase);
}

/// The nearest count, as a position; step 0: nothing is counted. Between two counts it does not follow its input.
template <class T>
T counted(const T& step, const T& u) {
  if (!(plain(step) > 0)) return u;
  return std::round(plain(u) / plain(step)) * step;
}

}  // namespace hysteron::encoder
