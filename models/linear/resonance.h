// Decides the motion of one damped mode that is known by its frequency. Does not decide what drives it, nor what it
// moves.
#pragma once

namespace hysteron::resonance {

/// A mode that follows u: q'' + 2 z w q' + w^2 q = w^2 u, as dq/dt = w v, dv/dt = w (u - q - 2 z v). q and u in one
/// unit, v = q'/w in the same: both states are of one size at the resonance. frequency [Hz] (w = 2 pi frequency),
/// damping z [-]. Source: second-order low-pass, definition.
template <class T>
struct Rates {
  T q, v;
};
template <class T>
Rates<T> rates(const T& frequency, const T& damping, const T& q, const T& v, const T& u) {
  const T w = frequency * 6.283185307179586476925287;
  return {w * v, w * (u - q - 2.0 * damping * v)};
}

}  // namespace hysteron::resonance
