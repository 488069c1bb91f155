// Decides how a part that follows late moves over a straight piece of way. Does not decide what that part
// is.
#pragma once

#include <cmath>

namespace hysteron::late {

/// tau dh/dt = H - h over a row of `duration` [s] in which H went straight from `before` to `now`: h at its end, from h
/// at its begin. Exact for any tau > 0 [s]; H and h in one unit.
/// `keep` = exp(-duration/tau), for who knows it.
inline double after_ramp(double tau, double h, double before, double now, double duration, double keep) {
  const double slope = (now - before) / duration;
  // The particular solution is H - tau slope; what differs from it at the begin dies away.
  return (now - tau * slope) + (h - (before - tau * slope)) * keep;
}
inline double after_ramp(double tau, double h, double before, double now, double duration) {
  return duration > 0 ? after_ramp(tau, h, before, now, duration, std::exp(-duration / tau)) : h;
}

/// The same for a part w - ahead u of an operator that stands still until it is taken along: over a row in which u
/// moves straight from u0 to u1 it keeps w0 at first and then goes with u to w1. Exact. `keep` = exp(-duration/tau).
inline double after_row(double tau, double h, double ahead, double w0, double w1, double u0, double u1, double duration,
                        double keep) {
  const double way = u1 - u0, moved = w1 - w0;
  // The operator moves as fast as u, in the last part of the row; all of it, but for the rounding of w.
  const double share = way != 0 ? moved / way : 0, rounding = 1e-12;
  if (duration > 0 && (share >= 1 - rounding || !(share > 0)))  // mostly
    return after_ramp(tau, h, w0 - ahead * u0, w1 - ahead * u1, duration, keep);
  const double still = share < 1 ? 1 - share : 0;
  const double u_taken = u0 + still * way;
  h = after_ramp(tau, h, w0 - ahead * u0, w0 - ahead * u_taken, still * duration);
  return after_ramp(tau, h, w0 - ahead * u_taken, w1 - ahead * u1, (1 - still) * duration);
}

}  // namespace hysteron::late
