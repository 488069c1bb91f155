// Decides the coefficients of digital filters by kind and corner: poles of the analog prototype in closed form, moved
// to the pass band, sampled by the bilinear transform with the corners prewarped, so that they are met exactly. Does
// not filter: sections.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "models/sampled/sections.h"

namespace hysteron::filter_design {

enum class Family { butterworth, chebyshev };
enum class Pass { low, high, band, stop };

struct Wanted {
  Family family = Family::butterworth;
  Pass pass = Pass::low;
  int order = 2;      ///< of the prototype: band and stop have twice as many poles
  double corner = 1;  ///< [Hz] below 1/(2 period); of band and stop the lower one
  double upper = 0;   ///< [Hz] band and stop: the upper corner, above the lower one
  double ripple = 1;  ///< [dB] Chebyshev: by how much the gain dips in the pass band, and stands at the corners
  double period = 1;  ///< [s]
};

using Complex = std::complex<double>;

/// Sections that a filter needs.
constexpr int sections(Pass pass, int order) {
  return pass == Pass::band || pass == Pass::stop ? order : (order + 1) / 2;
}

/// The ripple as eps: the gain dips to 1/sqrt(1 + eps^2).
inline double ripple_of(double decibel) { return std::sqrt(std::pow(10, decibel / 10) - 1); }

/// Poles of the prototype whose corner is at 1 rad/s, those with an imaginary part at least zero: of a pair the upper
/// one. Butterworth: exp(i (pi/2 + t)); Chebyshev of type I: -sinh(m) sin(t) + i cosh(m) cos(t), m = asinh(1/eps)/n; t
/// = pi (2 k + 1)/(2 n). Source: Oppenheim, Schafer (2010), appendix B.
inline std::vector<Complex> prototype(const Wanted& w) {
  std::vector<Complex> poles;
  const double n = w.order, m = std::asinh(1 / ripple_of(w.ripple)) / n;
  for (int k = 0; 2 * k < w.order; ++k) {
    const double t = std::numbers::pi * (2 * k + 1) / (2 * n);
    const bool real = 2 * k + 1 == w.order;
    const double across = real ? 0 : std::cos(t);
    poles.push_back(w.family == Family::butterworth ? Complex(-std::sin(t), across)
                                                    : Complex(-std::sinh(m) * std::sin(t), std::cosh(m) * across));
  }
  return poles;
}

/// The place in z of the place s, which is in units of 2/period.
inline Complex bilinear(const Complex& s) { return (1.0 + s) / (1.0 - s); }

/// The corner f as the bilinear transform has it, in units of 2/period.
inline double prewarped(double frequency, double period) { return std::tan(std::numbers::pi * frequency * period); }

/// Denominator from two poles in z that are both real or a pair.
inline sections::Section with_poles(const Complex& p, const Complex& q) {
  sections::Section s;
  s.a1 = -(p + q).real();
  s.a2 = (p * q).real();
  return s;
}

/// Pairs of poles in z, one per section (the second 0: a section of first order).
inline std::vector<std::pair<Complex, Complex>> pole_pairs(const Wanted& w) {
  std::vector<std::pair<Complex, Complex>> pairs;
  const double low = prewarped(w.corner, w.period);
  const auto put = [&](const Complex& s) { pairs.emplace_back(bilinear(s), std::conj(bilinear(s))); };
  for (const Complex& p : prototype(w)) {
    if (w.pass == Pass::low || w.pass == Pass::high) {
      const Complex s = w.pass == Pass::low ? p * low : low / p;
      p.imag() == 0 ? void(pairs.emplace_back(bilinear(s), 0.0)) : put(s);
      continue;
    }
    const double high = prewarped(w.upper, w.period), middle = low * high;
    const Complex half = 0.5 * (high - low) * (w.pass == Pass::band ? p : 1.0 / p);
    const Complex root = std::sqrt(half * half - middle);
    if (p.imag() == 0) {
      pairs.emplace_back(bilinear(half + root), bilinear(half - root));  // both real, or a pair
    } else {
      put(half + root);
      put(half - root);
    }
  }
  // The least damped sections last: what comes first has taken from their input what would overshoot.
  std::stable_sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) {
    return std::max(std::abs(a.first), std::abs(a.second)) < std::max(std::abs(b.first), std::abs(b.second));
  });
  return pairs;
}

/// The sections, the gain in the pass band one (Chebyshev: at its largest).
inline std::vector<sections::Section> design(const Wanted& w) {
  std::vector<sections::Section> all;
  const double middle =
      w.pass == Pass::low || w.pass == Pass::high ? 0 : prewarped(w.corner, w.period) * prewarped(w.upper, w.period);
  const Complex centre = bilinear(Complex(0, std::sqrt(middle)));
  // Where the prototype's zero frequency comes to lie.
  const Complex reference = w.pass == Pass::high ? -1.0 : w.pass == Pass::band ? centre : 1.0;
  const bool dips = w.family == Family::chebyshev && w.order % 2 == 0;
  const double top = dips ? 1 / std::hypot(1.0, ripple_of(w.ripple)) : 1.0;
  for (const auto& [p, q] : pole_pairs(w)) {
    sections::Section s = with_poles(p, q);
    const bool single = q == 0.0;
    if (w.pass == Pass::low || w.pass == Pass::high) {
      const double sign = w.pass == Pass::low ? 1 : -1;
      s.b1 = single ? sign : 2 * sign;
      s.b2 = single ? 0 : 1;
    } else {
      s.b1 = w.pass == Pass::band ? 0 : -2 * centre.real();
      s.b2 = w.pass == Pass::band ? -1 : 1;
    }
    const Complex d = 1.0 / reference;
    const double gain = std::abs((1.0 + s.b1 * d + s.b2 * d * d) / (1.0 + s.a1 * d + s.a2 * d * d));
    const double factor = (all.empty() ? top : 1.0) / gain;
    s.b0 = factor;
    s.b1 *= factor;
    s.b2 *= factor;
    all.push_back(s);
  }
  return all;
}

}  // namespace hysteron::filter_design
