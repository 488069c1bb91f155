// Decides a section of first order that is known by its corner frequencies: one pole, one zero. Does not decide time
// constants: creep.h.
#pragma once

namespace hysteron::first_order {

/// The state follows u: x' = 2 pi pole (u - x), pole [Hz]. Its transfer function is 1/(1 + s/w_p).
template <class T>
T rate(const T& pole, const T& x, const T& u) {
  return 6.283185307179586476925287 * pole * (u - x);
}

/// (1 + s/w_z)/(1 + s/w_p) for the state x of the pole: x + (w_p/w_z)(u - x). An infinite zero leaves the pole alone.
/// The phase is largest at sqrt(zero pole): asin((pole - zero)/(pole + zero)).
/// Source: Franklin, Powell, Emami-Naeini, Feedback Control of Dynamic Systems, 8th ed. (2019), section 6.7.
template <class T>
T lead(const T& zero, const T& pole, const T& x, const T& u) {
  return x + pole / zero * (u - x);
}

}  // namespace hysteron::first_order
