// Decides the test signals: their formulas, and for piecewise ones which piece holds a time and where the pieces meet.
// Does not know of solvers: a caller asks for the piece first and evaluates its smooth formula, also slightly beyond
// its end.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "models/random.h"

namespace hysteron::signals {

inline constexpr double pi = 3.141592653589793238462643;
inline constexpr double never = std::numeric_limits<double>::infinity();

/// Largest j with corner(j) <= time. `guess` may be off by rounding; the corners as computed decide, so that the piece
/// at a corner is always the one behind it.
template <class Breakpoint>
double piece_at(double time, double guess, Breakpoint breakpoint) {
  double j = std::floor(guess);
  for (int step = 0; step < 3 && breakpoint(j + 1) <= time; ++step) ++j;
  for (int step = 0; step < 3 && breakpoint(j) > time; ++step) --j;
  return j;
}

/// `corner`, or the next number behind `time` where rounding has eaten the distance.
inline double strictly_behind(double time, double breakpoint) {
  return std::max(breakpoint, std::nextafter(time, never));
}

/// sin(2 pi f t + phase): t [s], f [Hz], phase [rad].
template <class T>
T sine(const T& t, const T& frequency, const T& phase) {
  using std::sin;
  return sin(T{2 * pi} * frequency * t + phase);
}

// Triangle between -1 and 1 with the zeros and extremes of sine(): rises on pieces with even number, falls on odd ones.
inline double triangle_breakpoint(double frequency, double phase, double j) {
  return (j / 2 - phase / (2 * pi) - 0.25) / frequency;
}
inline double triangle_piece(double frequency, double phase, double time) {
  const double guess = 2 * (frequency * time + phase / (2 * pi) + 0.25);
  return piece_at(time, guess, [&](double j) { return triangle_breakpoint(frequency, phase, j); });
}
template <class T>
T triangle(const T& t, const T& frequency, const T& phase, double piece) {
  const T along = T{4} * (frequency * t + phase / T{2 * pi} + T{0.25 - piece / 2});  // 0 .. 2 on the piece
  return std::fmod(std::fabs(piece), 2) == 0 ? along - T{1} : T{1} - along;
}

/// Number of the level that holds `time`: piece k is [k duration, (k + 1) duration), the first and last go on for ever.
inline double staircase_piece(double duration, double levels, double time) {
  const double k = piece_at(time, time / duration, [&](double j) { return j * duration; });
  return std::clamp(k, 0.0, levels - 1);
}
inline double staircase_next_breakpoint(double duration, double levels, double time) {
  const double next = std::max(piece_at(time, time / duration, [&](double j) { return j * duration; }) + 1, 1.0);
  return next > levels - 1 ? never : strictly_behind(time, next * duration);
}

enum class Sweep { linear, logarithmic };

/// (exp(rate x) - 1)/rate, also for rate near zero, where the quotient would lose its digits.
template <class T>
T growth(const T& rate, const T& x) {
  using std::abs;
  using std::exp;
  const T z = rate * x;
  if (abs(rate) > T{1e-3}) return (exp(z) - T{1}) / rate;
  return x * (T{1} + z / T{2} * (T{1} + z / T{3} * (T{1} + z / T{4} * (T{1} + z / T{5}))));
}

/// Cycles run through by a chirp since t = 0: `from` before 0, sweeping until `duration`, `to` behind it; its rate is
/// the instantaneous frequency [Hz], continuous. piece -1, 0, 1 = before, during, behind the sweep.
template <class T>
T chirp_cycles(const T& t, const T& from, const T& to, const T& duration, Sweep sweep, int piece) {
  using std::log;
  if (piece < 0) return from * t;
  const T s = piece == 0 ? t / duration : T{1};
  T cycles{0};
  if (sweep == Sweep::linear)
    cycles = duration * s * (from + (to - from) * s / T{2});
  else
    cycles = from * duration * growth(T{log(to / from)}, s);
  return piece == 0 ? cycles : cycles + to * (t - duration);
}

/// How many frequencies lowest, lowest + spacing ... are not above highest (rounding forgiven).
inline double multisine_count(double lowest, double highest, double spacing) {
  return std::floor((highest - lowest) / spacing * (1 + 1e-12) + 1e-9) + 1;
}

/// Sum of `count` sines of equal amplitude and random phases with root mean square 1 over the common period.
/// Source: Pintelon, Schoukens, System Identification: A Frequency Domain Approach, 2nd ed. (2012), section 2.
template <class T>
T multisine(const T& t, const T& lowest, const T& spacing, double count, std::uint64_t seed) {
  T sum{0};
  for (double k = 0; k < count; ++k) {
    const double phase = 2 * pi * random::uniform(seed, 0, static_cast<std::uint64_t>(k));
    sum += sine(t, T{lowest + T{k} * spacing}, T{phase});
  }
  return T{std::sqrt(2 / count)} * sum;
}

}  // namespace hysteron::signals
