// Decides the relay with hysteresis: two modes, when each may stay, what it gives. Does not locate the switching.
#pragma once

namespace hysteron::relay {

enum Mode { off, on };

/// Switches on where the input reaches on_at, off where it falls to off_at; off_at < on_at, in the input's unit.
template <class T>
struct Params {
  T on_at{1}, off_at{0};
  T on_value{1}, off_value{0};
};

/// Distance of the input from the switching level of the mode: positive = the mode may stay.
/// Source: Visintin, Differential Models of Hysteresis (1994) (delayed relay).
template <class T>
T guard(const Params<T>& p, Mode mode, const T& u) {
  return mode == on ? u - p.off_at : p.on_at - u;
}

/// What follows a mode whose guard is not positive.
inline Mode next(Mode mode) { return mode == on ? off : on; }

template <class T>
T output(const Params<T>& p, Mode mode) {
  return mode == on ? p.on_value : p.off_value;
}

}  // namespace hysteron::relay
