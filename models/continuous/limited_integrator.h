// Decides an integrator between limits that a signal may set anew: its modes, when each may stay, what follows. Does
// not locate the transitions.
#pragma once

#include <algorithm>

namespace hysteron::limited_integrator {

/// Whether it moves, and whether the reset signal is on: bits of one mode.
enum Where { free, at_lower, at_upper };
struct Mode {
  Where where = free;
  bool on = false;
  int number() const { return static_cast<int>(where) + (on ? 3 : 0); }
  static Mode of(int number) { return {static_cast<Where>(number % 3), number >= 3}; }
};

enum class Reset { rising, falling, either, while_on };

/// The reset signal counts as on above this; how far it or the integral passes a level before it counts, so that what
/// follows may begin on the level itself.
inline constexpr double on_level = 0.5, margin = 1e-9;

template <class T>
struct Limits {
  T lower{}, upper{};
};

/// Does the signal hold the integral?
inline bool holds(Reset kind, const Mode& m) { return kind == Reset::while_on && m.on; }

/// Positive until the signal changes sides.
template <class T>
T to_turn(const Mode& m, const T& signal) {
  return (m.on ? T{signal - T{on_level}} : T{T{on_level} - signal}) + T{margin};
}

/// dx/dt: u where it moves, 0 at a limit or while it is held.
template <class T>
T rate(Reset kind, const Mode& m, const T& u) {
  return m.where != free || holds(kind, m) ? T{0} : u;
}

/// Positive = the mode may stay: room to the nearer limit where free, what presses against the limit there; and, with a
/// signal, how far that is from changing sides. Room counts in shares of the range where both limits are finite, so
/// that the margin is none of a unit.
template <class T>
T guard(Reset kind, const Mode& m, const Limits<T>& limit, const T& x, const T& u, const T* signal) {
  using std::min;
  const T range = limit.upper - limit.lower, room = min(T{x - limit.lower}, T{limit.upper - x});
  T stay = (range < T{1e300} ? T{room / range} : room) + T{margin};
  if (m.where == at_upper) stay = u;
  if (m.where == at_lower) stay = -u;
  if (holds(kind, m)) stay = T{1};
  return signal == nullptr ? stay : min(stay, to_turn(m, *signal));
}

/// What follows a mode whose guard is not positive.
template <class T>
Mode next(Reset kind, const Mode& m, const Limits<T>& limit, const T& x, const T* signal) {
  if (signal != nullptr && to_turn(m, *signal) <= T{0}) return {free, !m.on};
  if (holds(kind, m) || m.where != free) return {free, m.on};
  return {limit.upper - x < x - limit.lower ? at_upper : at_lower, m.on};
}

/// The integral behind a step of h [s] while u goes straight from `begin` to `end`, held between the limits: exact,
/// since u changes its sign once at most.
inline double after(const Limits<double>& limit, double x, double begin, double end, double h) {
  const auto held = [&](double y) { return std::max(limit.lower, std::min(limit.upper, y)); };
  if (begin * end >= 0) return held(x + 0.5 * h * (begin + end));
  const double turn = begin / (begin - end);
  return held(held(x + 0.5 * h * turn * begin) + 0.5 * h * (1 - turn) * end);
}

/// Does it begin anew between these modes?
inline bool restarts(Reset kind, const Mode& before, const Mode& after) {
  if (before.on == after.on) return false;
  return kind == Reset::either || (kind == Reset::falling ? !after.on : after.on);
}

}  // namespace hysteron::limited_integrator
