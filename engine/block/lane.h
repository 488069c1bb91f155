// Decides the scalar of runs side by side ("lanes"): a double whose functions have no branches and call nothing, so
// that a loop over lanes around a block's function becomes vector instructions. Does not decide how lanes are laid out
// (kernel.h, LanesView) nor how they are advanced (lanes.h).
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace hysteron {

/// One number of one lane. Not double itself, since its tanh and exp must be ours: those of the C library are calls.
/// The same bits on every machine and for every width of its vectors (the build forbids other contractions than those
/// written here).
struct Lane {
  double v = 0;

  constexpr Lane() = default;
  constexpr Lane(double value) : v(value) {}  // NOLINT: constants are numbers of every lane

  Lane& operator+=(Lane b) { return *this = Lane(v + b.v); }
  Lane& operator-=(Lane b) { return *this = Lane(v - b.v); }
  Lane& operator*=(Lane b) { return *this = Lane(v * b.v); }
  Lane& operator/=(Lane b) { return *this = Lane(v / b.v); }

  friend constexpr Lane operator-(Lane a) { return {-a.v}; }
  friend constexpr Lane operator+(Lane a) { return a; }
  friend constexpr Lane operator+(Lane a, Lane b) { return {a.v + b.v}; }
  friend constexpr Lane operator-(Lane a, Lane b) { return {a.v - b.v}; }
  friend constexpr Lane operator*(Lane a, Lane b) { return {a.v * b.v}; }
  friend constexpr Lane operator/(Lane a, Lane b) { return {a.v / b.v}; }
  friend constexpr bool operator<(Lane a, Lane b) { return a.v < b.v; }
  friend constexpr bool operator>(Lane a, Lane b) { return a.v > b.v; }
  friend constexpr bool operator<=(Lane a, Lane b) { return a.v <= b.v; }
  friend constexpr bool operator>=(Lane a, Lane b) { return a.v >= b.v; }
  friend constexpr bool operator==(Lane a, Lane b) { return a.v == b.v; }
};

inline double value_of(Lane a) { return a.v; }

namespace lane_detail {

/// e^y = power (1 + rest): power = 2^k, y = k ln 2 + r, |r| <= ln(2)/2, rest = e^r - 1 by its power series up to r^13
/// (the next term is 1e-17 of it). For -708 < y < 709.4; y outside gives nonsense. Source: Cody, Waite, Software Manual
/// for the Elementary Functions, 1980, chapter 6.
struct Exponential {
  double power, rest;
  double whole() const { return __builtin_fma(power, rest, power); }
  double less_one() const { return __builtin_fma(power, rest, power - 1); }  // near zero as exact as elsewhere
};
inline Exponential exponential(double y) {
  constexpr double round_to_integer = 0x1.8p52;  // added, it leaves the nearest integer in the last bits
  constexpr double ln2_high = 0x1.62e42fefa0000p-1, ln2_low = 0x1.cf79abc9e3b3ap-40;
  const auto fma = [](double a, double b, double c) { return __builtin_fma(a, b, c); };
  const double shifted = fma(y, 1.4426950408889634, round_to_integer);
  const double k = shifted - round_to_integer;
  const double r = fma(k, -ln2_low, fma(k, -ln2_high, y));
  const double power = std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) << 52) + 0x3ff0000000000000U);
  const double r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
  const double a = fma(r2, fma(r, 1.0 / 24, 1.0 / 6), fma(r, 0.5, 1.0));
  const double b = fma(r2, fma(r, 1.0 / 40320, 1.0 / 5040), fma(r, 1.0 / 720, 1.0 / 120));
  const double c = fma(r2, fma(r, 1.0 / 479001600, 1.0 / 39916800), fma(r, 1.0 / 3628800, 1.0 / 362880));
  return {power, r * fma(r8, fma(r4, 1.0 / 6227020800.0, c), fma(r4, b, a))};
}

/// A comparison with something that is not a number is false: it stays as it is.
inline double at_most(double y, double limit) { return y > limit ? limit : y; }
inline double at_least(double y, double limit) { return y < limit ? limit : y; }

}  // namespace lane_detail

/// tanh to some 7e-16 of itself: (e^2a - 1)/(e^2a + 1), which is one beyond 2a = 44 but for rounding.
inline Lane tanh(Lane a) {
  const double e = lane_detail::exponential(lane_detail::at_least(lane_detail::at_most(2 * a.v, 44), -44)).less_one();
  return {e / (e + 2)};
}
/// Good to some 5e-16 of itself. Infinite from 709.4 on (the largest number is e^709.78), zero below -708, where the
/// last numbers are no normal ones.
inline Lane exp(Lane a) {
  const double inside = lane_detail::at_least(lane_detail::at_most(a.v, 709.4), -708);
  const double e = lane_detail::exponential(inside).whole();
  return {a.v > 709.4 ? HUGE_VAL : a.v < -708 ? 0 : e};
}
/// ln(2^k m) = k ln 2 + ln m, sqrt(1/2) <= m < sqrt(2), ln m = 2 artanh((m - 1)/(m + 1)) by its power series up to
/// s^21 (the next term is 4e-18). Good to some 4e-16 of itself, or of ln 2 beside one.
inline Lane log(Lane a) {
  constexpr double ln2_high = 0x1.62e42fefa0000p-1, ln2_low = 0x1.cf79abc9e3b3ap-40;
  const auto fma = [](double x, double y, double z) { return __builtin_fma(x, y, z); };
  const bool tiny = a.v < 0x1p-1022;  // no normal number: made one
  const double x = tiny ? a.v * 0x1p54 : a.v;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  // The exponent as a double: its bits below those of 2^52.
  const double exponent = std::bit_cast<double>((bits >> 52) | 0x4330000000000000U) - 0x1p52;
  const double whole = std::bit_cast<double>((bits & 0x000fffffffffffffU) | 0x3ff0000000000000U);  // 1 ... 2
  const bool upper = whole > 1.4142135623730951;
  const double m = upper ? 0.5 * whole : whole;
  const double k = exponent - (tiny ? 1077 : 1023) + (upper ? 1 : 0);
  const double f = m - 1, s = f / (2 + f), z = s * s;
  double series = 2.0 / 21;
  for (int n = 19; n >= 3; n -= 2) series = fma(series, z, 2.0 / n);
  // ln m = f - s (f - z series): exact where m is near one. Source: fdlibm, e_log.c.
  const double ln = fma(k, ln2_high, f - (s * (f - z * series) - k * ln2_low));
  const double beyond = a.v < 0 ? NAN : a.v == 0 ? -HUGE_VAL : ln;
  return {a.v < HUGE_VAL ? beyond : a.v};  // infinite, or not a number
}
inline Lane max(Lane a, Lane b) { return b.v > a.v ? b : a; }
inline Lane min(Lane a, Lane b) { return b.v < a.v ? b : a; }
inline Lane abs(Lane a) { return {std::fabs(a.v)}; }
inline Lane sqrt(Lane a) { return {std::sqrt(a.v)}; }
inline Lane floor(Lane a) { return {std::floor(a.v)}; }

/// a^n for a not below zero (what laws take powers of), else not a number; the error of n ln a shows: |n ln a| 1e-16.
inline Lane pow(Lane a, double n) {
  const double power = exp(Lane(n) * log(a)).v;
  return {n == 0 ? 1 : a.v == 0 ? (n > 0 ? 0 : HUGE_VAL) : power};
}

// Called lane by lane: right, and slow.
inline Lane sin(Lane a) { return {std::sin(a.v)}; }
inline Lane cos(Lane a) { return {std::cos(a.v)}; }
inline Lane tan(Lane a) { return {std::tan(a.v)}; }
inline Lane asin(Lane a) { return {std::asin(a.v)}; }
inline Lane acos(Lane a) { return {std::acos(a.v)}; }
inline Lane atan(Lane a) { return {std::atan(a.v)}; }
inline Lane sinh(Lane a) { return {std::sinh(a.v)}; }
inline Lane cosh(Lane a) { return {std::cosh(a.v)}; }
inline Lane cbrt(Lane a) { return {std::cbrt(a.v)}; }
inline Lane atan2(Lane y, Lane x) { return {std::atan2(y.v, x.v)}; }
inline Lane hypot(Lane a, Lane b) { return {std::hypot(a.v, b.v)}; }
inline Lane pow(Lane a, Lane n) { return {std::pow(a.v, n.v)}; }

}  // namespace hysteron
