// Decides pulse width modulation by a triangular carrier, and what a bridge makes of it. Does not look for the edges.
#pragma once

#include <cmath>

namespace hysteron::pulse_width {

/// bipolar: +1 or -1 (both legs of a bridge change together); unipolar: +1, 0 or -1 (each leg by itself: twice as many
/// pulses); single: 1 or 0 (one switch).
enum class Modulation { bipolar, unipolar, single };

/// Triangle of the frequency f [Hz] between -1 and 1, -1 at t = 0 [s]. Corners at multiples of 1/(2 f).
template <class T>
T carrier(const T& frequency, const T& t) {
  using std::abs;
  using std::floor;
  const T turns = frequency * t;
  return 1.0 - 4.0 * abs(T{turns - floor(turns) - 0.5});
}

/// Level with which the carrier is compared: from a duty of -1 ... 1, or 0 ... 1 of a single switch.
template <class T>
T level(Modulation modulation, const T& duty) {
  return modulation == Modulation::single ? T{2.0 * duty - 1.0} : duty;
}

/// A leg that is on (1) as long as its level is above the carrier; a second one compares the opposite level, where the
/// legs switch each by itself.
struct Legs {
  bool first = false, second = false;
};

/// What is switched, natural sampling: its mean over a period of the carrier is the duty, where that stands still.
/// Source: Holmes, Lipo, Pulse Width Modulation for Power Converters (2003), section 3.1.
inline double gate(Modulation modulation, const Legs& legs) {
  if (modulation == Modulation::unipolar) return (legs.first ? 1 : 0) - (legs.second ? 1 : 0);
  return legs.first ? 1 : modulation == Modulation::single ? 0 : -1;
}

/// Positive while a leg may stay as it is. It changes a little behind the carrier, so that a duty of exactly one, whose
/// level the carrier's tip touches, has no pulses of no width.
template <class T>
T reserve(bool on, const T& level, const T& carrier) {
  constexpr double behind = 1e-12;
  return (on ? T{level - carrier} : T{carrier - level}) + behind;
}

/// First corner of the carrier behind t [s].
inline double next_corner(double frequency, double t) { return (std::floor(2 * frequency * t) + 1) / (2 * frequency); }

}  // namespace hysteron::pulse_width
