// Decides how a value carries its rate in time: forward differentiation with one direction.
// Models are templates over their scalar; with Dual they return the exact d/dt of what they compute.
#pragma once

#include <cmath>

namespace hysteron {

struct Dual {
  double value = 0;
  double rate = 0;  ///< d value / dt

  constexpr Dual() = default;
  constexpr Dual(double v) : value(v) {}  // NOLINT: constants have rate zero
  constexpr Dual(double v, double r) : value(v), rate(r) {}

  Dual& operator+=(const Dual& b) { return *this = {value + b.value, rate + b.rate}; }
  Dual& operator-=(const Dual& b) { return *this = {value - b.value, rate - b.rate}; }
  Dual& operator*=(const Dual& b) { return *this = {value * b.value, rate * b.value + value * b.rate}; }
};

inline double value_of(double a) { return a; }
inline double value_of(const Dual& a) { return a.value; }

inline Dual operator-(const Dual& a) { return {-a.value, -a.rate}; }
inline Dual operator+(const Dual& a) { return a; }
inline Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.rate + b.rate}; }
inline Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.rate - b.rate}; }
inline Dual operator*(const Dual& a, const Dual& b) { return {a.value * b.value, a.rate * b.value + a.value * b.rate}; }
inline Dual operator/(const Dual& a, const Dual& b) {
  const double q = a.value / b.value;
  return {q, (a.rate - q * b.rate) / b.value};
}
inline bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
inline bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
inline bool operator<=(const Dual& a, const Dual& b) { return a.value <= b.value; }
inline bool operator>=(const Dual& a, const Dual& b) { return a.value >= b.value; }
inline bool operator==(const Dual& a, const Dual& b) { return a.value == b.value; }

// At a tie the first argument's rate counts: the one-sided rate of the branch that was active before.
inline Dual max(const Dual& a, const Dual& b) { return b.value > a.value ? b : a; }
inline Dual min(const Dual& a, const Dual& b) { return b.value < a.value ? b : a; }
inline Dual abs(const Dual& a) { return a.value < 0 ? -a : a; }
inline Dual sqrt(const Dual& a) {
  const double s = std::sqrt(a.value);
  return {s, a.rate / (2 * s)};
}
inline Dual exp(const Dual& a) {
  const double e = std::exp(a.value);
  return {e, e * a.rate};
}
inline Dual log(const Dual& a) { return {std::log(a.value), a.rate / a.value}; }
inline Dual sin(const Dual& a) { return {std::sin(a.value), std::cos(a.value) * a.rate}; }
inline Dual cos(const Dual& a) { return {std::cos(a.value), -std::sin(a.value) * a.rate}; }
inline Dual tanh(const Dual& a) {
  const double h = std::tanh(a.value);
  return {h, (1 - h * h) * a.rate};
}
inline Dual floor(const Dual& a) { return {std::floor(a.value), 0.0}; }
inline Dual pow(const Dual& a, double n) {
  return {std::pow(a.value, n), n == 0 ? 0.0 : n * std::pow(a.value, n - 1) * a.rate};
}

}  // namespace hysteron
