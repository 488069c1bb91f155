// Decides a follower of limited rate: closing its gap to the input, or rising or falling at its limit. A
// current-limited amplifier on a capacitive load is this law with rate = current/capacitance. Does not locate the
// transitions.
#pragma once

#include <algorithm>
#include <cmath>

namespace hysteron::rate_limiter {

enum Mode { tracking, rising, falling };

/// Units for a signal in V.
template <class T>
struct Params {
  T rise{1};  ///< [V/s] largest rate, positive; may be infinite
  T fall{1};  ///< [V/s] largest rate downwards, positive; may be infinite
  T time{1};  ///< [s]   time constant with which a small gap closes, positive
};

/// The limit is left only where the gap asks for less than this share of it, so that nothing depends on an exact tie.
inline constexpr double leave = 1 - 1e-6;

/// Rate that the gap asks for: (u - y)/tau.
template <class T>
T asked(const Params<T>& p, const T& y, const T& u) {
  return (u - y) / p.time;
}

/// dy/dt = max(-fall, min(rise, (u - y)/tau)), one smooth piece per mode; the pieces meet without a jump.
/// Source: |dy/dt| <= I/C of a capacitor fed by a limited current, behind an amplifier of bandwidth 1/(2 pi tau).
template <class T>
T rate(const Params<T>& p, Mode mode, const T& y, const T& u) {
  if (mode == tracking) return asked(p, y, u);
  return mode == rising ? p.rise : T{-p.fall};
}

/// Positive = the mode may stay: reserve of rate while tracking, rate asked for beyond the limit at a limit. [V/s]
template <class T>
T guard(const Params<T>& p, Mode mode, const T& y, const T& u) {
  using std::min;
  const T w = asked(p, y, u);
  if (mode == rising) return w - T{leave} * p.rise;
  if (mode == falling) return -w - T{leave} * p.fall;
  return min(T{p.rise - w}, T{p.fall + w});
}

/// What follows a mode whose guard is not positive.
template <class T>
Mode next(const Params<T>& p, const T& y, const T& u) {
  const T w = asked(p, y, u);
  if (w >= p.rise) return rising;
  return w <= -p.fall ? falling : tracking;
}

/// The follower after an input u that was held for `duration` [s]: a ramp until the gap is rate x tau, then an
/// exponential. Exact, needs no modes.
template <class T>
T after_hold(const Params<T>& p, const T& y, const T& u, const T& duration) {
  using std::exp;
  const bool up = u >= y;
  const T limit = up ? p.rise : p.fall;
  const T gap = up ? T{u - y} : T{y - u};
  T ramp{0};  // [s]
  T left = gap;
  if (gap > limit * p.time) {
    ramp = gap / limit - p.time;
    if (duration <= ramp) return up ? T{y + limit * duration} : T{y - limit * duration};
    left = limit * p.time;
  }
  left *= exp(T{-(duration - ramp) / p.time});
  return up ? T{u - left} : T{u + left};
}

/// exp(-x), which is zero behind 746: functions of the library take fifty times as long to find that out, in each row
/// of a follower that is a million times as quick.
inline double decayed(double x) { return x > 746 ? 0.0 : std::exp(-x); }

/// The gap u - y after `duration` [s] in which the input went straight on with `slope` [V/s]; the follower keeps at
/// most its rates. Exact: at a limit the gap is a straight line, between them it closes exponentially, and each piece
/// is left once at most. A time constant of zero follows at once where the limits allow it.
inline double gap_after_ramp(const Params<double>& p, double gap, double slope, double duration) {
  const double most = p.time > 0 ? p.rise * p.time : 0, least = p.time > 0 ? -p.fall * p.time : 0;
  for (int piece = 0; piece < 4 && duration > 0; ++piece) {
    const bool up = gap > most || (gap == most && slope > p.rise);
    const bool down = gap < least || (gap == least && slope < -p.fall);
    if (up || down) {
      const double growth = up ? slope - p.rise : slope + p.fall, edge = up ? most : least;
      const double stay = up == (growth < 0) ? (edge - gap) / growth : duration;
      if (stay >= duration) return gap + growth * duration;
      gap = edge;
      duration -= stay;
      continue;
    }
    if (p.time == 0) return 0;  // between its limits
    const double steady = slope * p.time;
    const double edge = slope > p.rise ? most : least;
    const bool leaves = slope > p.rise || slope < -p.fall;
    const double stay = leaves ? p.time * std::log((steady - gap) / (steady - edge)) : duration;
    if (stay >= duration) return steady + (gap - steady) * decayed(duration / p.time);
    gap = edge;
    duration -= stay;
  }
  return gap;
}

}  // namespace hysteron::rate_limiter
