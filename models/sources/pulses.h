// Decides ramps, pulses and trapezoids: which straight piece holds a time, where the pieces meet, their formulas.
// Does not know of solvers: a caller asks for the piece first and evaluates it, also slightly beyond its end.
#pragma once

#include <algorithm>
#include <cmath>

#include "models/sources/signals.h"

namespace hysteron::signals {

/// Times of a ramp [s]: it begins at `time` and lasts `duration`, which may be infinite.
struct RampTimes {
  double time = 0, duration = never;

  /// -1, 0, 1: before, during, behind the ramp.
  int piece(double t) const { return t < time ? -1 : t < time + duration ? 0 : 1; }
  double next_breakpoint(double t) const { return t < time ? time : t < time + duration ? time + duration : never; }
};

/// Rectangular pulses of the duty 0 .. 1: pulse k is [time + k period, time + (k + duty) period), k = 0, 1 ...
/// Corner 2k begins it, corner 2k + 1 ends it; piece j is from corner j to the next.
struct PulseTimes {
  double period = 1, duty = 0.5, time = 0;
  double pulses = never;  ///< how many there are

  double corner(double j) const {
    const double k = std::floor(j / 2);
    return time + (k + (j == 2 * k ? 0.0 : duty)) * period;
  }
  double piece(double t) const {
    const double turns = (t - time) / period, k = std::floor(turns);
    const double j = piece_at(t, 2 * k + (turns - k >= duty ? 1 : 0), [&](double i) { return corner(i); });
    return std::clamp(j, -1.0, 2 * pulses - 1);
  }
  bool is_high(double piece) const { return piece >= 0 && std::fmod(piece, 2) == 0; }
  double next_breakpoint(double t) const {
    const double next = piece(t) + 1;
    return next > 2 * pulses - 1 ? never : strictly_behind(t, corner(next));
  }
};

/// Pulses with slopes: trapezoid k begins at time + k period, rises, stays on top, falls, and rests until the next
/// begins; a period of infinity makes one of them. Corner 4k begins it, 4k + 1 .. 4k + 3 are the ends of rise, top and
/// fall. period >= rise + top + fall. Source: the pulse of SPICE 3f.5, User's Manual, section 3.2.1.1.
struct TrapezoidTimes {
  double rise = 1, top = 1, fall = 1, period = never, time = 0;

  double begin(double k) const { return k == 0 ? time : time + k * period; }
  double corner(double j) const {
    const double k = std::floor(j / 4);
    const int i = static_cast<int>(j - 4 * k);
    const double at = begin(k) + (i > 0 ? rise : 0) + (i > 1 ? top : 0) + (i > 2 ? fall : 0);
    return i < 3 ? at : std::min(at, begin(k + 1));  // where there is no rest, rounding must not exchange them
  }
  double piece(double t) const {
    const double k = std::floor((t - time) / period), since = t - begin(k);
    const double part = since < rise ? 0 : since < rise + top ? 1 : since < rise + top + fall ? 2 : 3;
    const double j = piece_at(t, 4 * k + part, [&](double i) { return corner(i); });
    return std::isinf(period) ? std::clamp(j, -1.0, 3.0) : std::max(j, -1.0);
  }
  double next_breakpoint(double t) const {
    const double next = piece(t) + 1;
    return next > 3 && std::isinf(period) ? never : strictly_behind(t, corner(next));
  }
};

/// 0 .. 1: how far a trapezoid has risen on a piece.
template <class T>
T trapezoid(const T& t, const T& rise, const T& top, const T& fall, const T& period, const T& time, double piece) {
  const double k = std::floor(piece / 4);
  const int part = piece < 0 ? 3 : static_cast<int>(piece - 4 * k);
  if (part == 3) return T{0};
  if (part == 1) return T{1};
  const T since = k == 0 ? T{t - time} : T{t - time - T{k} * period};
  return part == 0 ? T{since / rise} : T{T{1} - (since - rise - top) / fall};
}

}  // namespace hysteron::signals
