// Decides how a value carries derivatives: its rate in time (Dual), its slopes along several directions at once (Jet),
// or both (DualOf<Jet>: the slopes of a rate). Models are templates over their scalar and return exact derivatives of
// what they compute.
#pragma once

#include <cmath>
#include <type_traits>

namespace hysteron {

inline double value_of(double a) { return a; }

/// A value with its slopes along `directions` directions: columns of a Jacobian, or parameters.
struct Jet {
  static constexpr int directions = 8;
  double value = 0;
  double slope[directions] = {};

  constexpr Jet() = default;
  constexpr Jet(double v) : value(v) {}  // NOLINT: constants have slope zero

  /// f(a) with its derivative at a.
  static Jet chain(double f, double df, const Jet& a) {
    Jet r(f);
    for (int i = 0; i < directions; ++i) r.slope[i] = df * a.slope[i];
    return r;
  }
  /// f(a, b) with its partial derivatives.
  static Jet chain(double f, double fa, const Jet& a, double fb, const Jet& b) {
    Jet r(f);
    for (int i = 0; i < directions; ++i) r.slope[i] = fa * a.slope[i] + fb * b.slope[i];
    return r;
  }

  Jet& operator+=(const Jet& b) { return *this = *this + b; }
  Jet& operator-=(const Jet& b) { return *this = *this - b; }
  Jet& operator*=(const Jet& b) { return *this = *this * b; }
  Jet& operator/=(const Jet& b) { return *this = *this / b; }

  friend Jet operator-(const Jet& a) { return chain(-a.value, -1, a); }
  friend Jet operator+(const Jet& a) { return a; }
  friend Jet operator+(const Jet& a, const Jet& b) { return chain(a.value + b.value, 1, a, 1, b); }
  friend Jet operator-(const Jet& a, const Jet& b) { return chain(a.value - b.value, 1, a, -1, b); }
  friend Jet operator*(const Jet& a, const Jet& b) { return chain(a.value * b.value, b.value, a, a.value, b); }
  friend Jet operator/(const Jet& a, const Jet& b) {
    const double q = a.value / b.value;
    return chain(q, 1 / b.value, a, -q / b.value, b);
  }
  friend bool operator<(const Jet& a, const Jet& b) { return a.value < b.value; }
  friend bool operator>(const Jet& a, const Jet& b) { return a.value > b.value; }
  friend bool operator<=(const Jet& a, const Jet& b) { return a.value <= b.value; }
  friend bool operator>=(const Jet& a, const Jet& b) { return a.value >= b.value; }
  friend bool operator==(const Jet& a, const Jet& b) { return a.value == b.value; }
};

inline double value_of(const Jet& a) { return a.value; }

// At a tie the first argument's slopes count: the one-sided slope of the branch that was active before.
inline Jet max(const Jet& a, const Jet& b) { return b.value > a.value ? b : a; }
inline Jet min(const Jet& a, const Jet& b) { return b.value < a.value ? b : a; }
inline Jet abs(const Jet& a) { return a.value < 0 ? -a : a; }
inline Jet sqrt(const Jet& a) {
  const double s = std::sqrt(a.value);
  return Jet::chain(s, 0.5 / s, a);
}
inline Jet exp(const Jet& a) {
  const double e = std::exp(a.value);
  return Jet::chain(e, e, a);
}
inline Jet log(const Jet& a) { return Jet::chain(std::log(a.value), 1 / a.value, a); }
inline Jet sin(const Jet& a) { return Jet::chain(std::sin(a.value), std::cos(a.value), a); }
inline Jet cos(const Jet& a) { return Jet::chain(std::cos(a.value), -std::sin(a.value), a); }
inline Jet tanh(const Jet& a) {
  const double h = std::tanh(a.value);
  return Jet::chain(h, 1 - h * h, a);
}
inline Jet sinh(const Jet& a) { return Jet::chain(std::sinh(a.value), std::cosh(a.value), a); }
inline Jet cosh(const Jet& a) { return Jet::chain(std::cosh(a.value), std::sinh(a.value), a); }
inline Jet tan(const Jet& a) {
  const double t = std::tan(a.value);
  return Jet::chain(t, 1 + t * t, a);
}
inline Jet asin(const Jet& a) { return Jet::chain(std::asin(a.value), 1 / std::sqrt(1 - a.value * a.value), a); }
inline Jet acos(const Jet& a) { return Jet::chain(std::acos(a.value), -1 / std::sqrt(1 - a.value * a.value), a); }
inline Jet atan(const Jet& a) { return Jet::chain(std::atan(a.value), 1 / (1 + a.value * a.value), a); }
inline Jet cbrt(const Jet& a) {
  const double c = std::cbrt(a.value);
  return Jet::chain(c, 1 / (3 * c * c), a);
}
inline Jet atan2(const Jet& y, const Jet& x) {
  const double square = x.value * x.value + y.value * y.value;
  return Jet::chain(std::atan2(y.value, x.value), x.value / square, y, -y.value / square, x);
}
inline Jet hypot(const Jet& a, const Jet& b) {
  const double h = std::hypot(a.value, b.value);
  return Jet::chain(h, a.value / h, a, b.value / h, b);
}
inline Jet floor(const Jet& a) { return {std::floor(a.value)}; }
inline Jet pow(const Jet& a, double n) {
  return Jet::chain(std::pow(a.value, n), n == 0 ? 0.0 : n * std::pow(a.value, n - 1), a);
}

/// a^n: of a base that is not positive only the slope along the base counts, the other is that of a constant exponent.
inline Jet pow(const Jet& a, const Jet& n) {
  const double p = std::pow(a.value, n.value);
  return Jet::chain(p, n.value == 0 ? 0.0 : n.value * std::pow(a.value, n.value - 1), a,
                    a.value > 0 ? p * std::log(a.value) : 0.0, n);
}

/// A value with its rate in time.
template <class T>
struct DualOf {
  T value{};
  T rate{};  ///< d value / dt

  constexpr DualOf() = default;
  constexpr DualOf(double v) : value(v) {}  // NOLINT: constants have rate zero
  constexpr DualOf(const T& v)              // NOLINT: so have numbers that do not depend on time
      requires(!std::is_same_v<T, double>)
      : value(v) {}
  constexpr DualOf(const T& v, const T& r) : value(v), rate(r) {}

  DualOf& operator+=(const DualOf& b) { return *this = *this + b; }
  DualOf& operator-=(const DualOf& b) { return *this = *this - b; }
  DualOf& operator*=(const DualOf& b) { return *this = *this * b; }
  DualOf& operator/=(const DualOf& b) { return *this = *this / b; }

  friend DualOf operator-(const DualOf& a) { return {-a.value, -a.rate}; }
  friend DualOf operator+(const DualOf& a) { return a; }
  friend DualOf operator+(const DualOf& a, const DualOf& b) { return {a.value + b.value, a.rate + b.rate}; }
  friend DualOf operator-(const DualOf& a, const DualOf& b) { return {a.value - b.value, a.rate - b.rate}; }
  friend DualOf operator*(const DualOf& a, const DualOf& b) {
    return {a.value * b.value, a.rate * b.value + a.value * b.rate};
  }
  friend DualOf operator/(const DualOf& a, const DualOf& b) {
    const T q = a.value / b.value;
    return {q, (a.rate - q * b.rate) / b.value};
  }
  friend bool operator<(const DualOf& a, const DualOf& b) { return a.value < b.value; }
  friend bool operator>(const DualOf& a, const DualOf& b) { return a.value > b.value; }
  friend bool operator<=(const DualOf& a, const DualOf& b) { return a.value <= b.value; }
  friend bool operator>=(const DualOf& a, const DualOf& b) { return a.value >= b.value; }
  friend bool operator==(const DualOf& a, const DualOf& b) { return a.value == b.value; }

  // At a tie the first argument's rate counts: the one-sided rate of the branch that was active before.
  friend DualOf max(const DualOf& a, const DualOf& b) { return b.value > a.value ? b : a; }
  friend DualOf min(const DualOf& a, const DualOf& b) { return b.value < a.value ? b : a; }
  friend DualOf abs(const DualOf& a) { return a.value < T(0.0) ? -a : a; }
  friend DualOf sqrt(const DualOf& a) {
    using std::sqrt;
    const T s = sqrt(a.value);
    return {s, a.rate / (2.0 * s)};
  }
  friend DualOf exp(const DualOf& a) {
    using std::exp;
    const T e = exp(a.value);
    return {e, e * a.rate};
  }
  friend DualOf log(const DualOf& a) {
    using std::log;
    return {log(a.value), a.rate / a.value};
  }
  friend DualOf sin(const DualOf& a) {
    using std::cos;
    using std::sin;
    return {sin(a.value), cos(a.value) * a.rate};
  }
  friend DualOf cos(const DualOf& a) {
    using std::cos;
    using std::sin;
    return {cos(a.value), -sin(a.value) * a.rate};
  }
  friend DualOf tanh(const DualOf& a) {
    using std::tanh;
    const T h = tanh(a.value);
    return {h, (1.0 - h * h) * a.rate};
  }
  friend DualOf sinh(const DualOf& a) {
    using std::cosh;
    using std::sinh;
    return {sinh(a.value), cosh(a.value) * a.rate};
  }
  friend DualOf cosh(const DualOf& a) {
    using std::cosh;
    using std::sinh;
    return {cosh(a.value), sinh(a.value) * a.rate};
  }
  friend DualOf tan(const DualOf& a) {
    using std::tan;
    const T t = tan(a.value);
    return {t, (1.0 + t * t) * a.rate};
  }
  friend DualOf asin(const DualOf& a) {
    using std::asin;
    using std::sqrt;
    return {asin(a.value), a.rate / sqrt(1.0 - a.value * a.value)};
  }
  friend DualOf acos(const DualOf& a) {
    using std::acos;
    using std::sqrt;
    return {acos(a.value), -a.rate / sqrt(1.0 - a.value * a.value)};
  }
  friend DualOf atan(const DualOf& a) {
    using std::atan;
    return {atan(a.value), a.rate / (1.0 + a.value * a.value)};
  }
  friend DualOf cbrt(const DualOf& a) {
    using std::cbrt;
    const T c = cbrt(a.value);
    return {c, a.rate / (3.0 * c * c)};
  }
  friend DualOf atan2(const DualOf& y, const DualOf& x) {
    using std::atan2;
    const T square = x.value * x.value + y.value * y.value;
    return {atan2(y.value, x.value), (x.value * y.rate - y.value * x.rate) / square};
  }
  friend DualOf hypot(const DualOf& a, const DualOf& b) {
    using std::hypot;
    const T h = hypot(a.value, b.value);
    return {h, (a.value * a.rate + b.value * b.rate) / h};
  }
  friend DualOf pow(const DualOf& a, const DualOf& n) {
    using std::log;
    using std::pow;
    const T p = pow(a.value, n.value);
    T rate = value_of(n.value) == 0 ? T(0.0) : n.value * pow(a.value, n.value - 1.0) * a.rate;
    if (value_of(a.value) > 0) rate = rate + p * log(a.value) * n.rate;
    return {p, rate};
  }
  friend DualOf floor(const DualOf& a) { return {T(std::floor(value_of(a.value))), T(0.0)}; }
  friend DualOf pow(const DualOf& a, double n) {
    using std::pow;
    return {pow(a.value, n), n == 0 ? T(0.0) : n * pow(a.value, n - 1) * a.rate};
  }
};

template <class T>
double value_of(const DualOf<T>& a) {
  return value_of(a.value);
}

using Dual = DualOf<double>;
using JetDual = DualOf<Jet>;

}  // namespace hysteron
