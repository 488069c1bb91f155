// Decides how a part that follows late moves over a straight piece of way. Does not decide what that part
// is.
#pragma once

#include <cmath>

namespace hysteron::late {

/// tau dh/dt = H - h over a row of `duration` [s] in which H went straight from `before` to `now`: h at its end, from h
/// at its begin. Exact for any tau > 0 [s]; H and h in one unit.
inline double after_ramp(double tau, double h, double before, double now, double duration) {
  if (!(duration > 0)) return h;
  const double slope = (now - before) / duration, keep = std::exp(-duration / tau);
  // The particular solution is H - tau slope; what differs from it at the begin dies away.
  return (now - tau * slope) + (h - (before - tau * slope)) * keep;
}

}  // namespace hysteron::late
