// Decides linear sections of second order: what their output makes of the states of a damped mode. Does not decide how
// the mode moves: resonance.h.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace hysteron::second_order {

/// Numerator of a section over s^2 + 2 z w s + w^2: high s^2 + band w s + low w^2 [y/u each]. Static gain: low; gain at
/// high frequencies: high.
template <class T>
struct Numerator {
  T low{1}, band{0}, high{0};
};

/// Output of a section for the states q, v = q'/w of the mode (resonance::rates) and the input u: s^2 q/w^2 is what the
/// equation of the mode leaves, u - q - 2 z v. Source: definition; Franklin, Powell, Emami-Naeini, Feedback Control of
/// Dynamic Systems, 8th ed. (2019), section 7.4 (canonical forms).
template <class T>
T output(const Numerator<T>& n, const T& damping, const T& q, const T& v, const T& u) {
  return n.low * q + n.band * v + n.high * (u - q - 2.0 * damping * v);
}

/// (s^2/w_z^2 + 2 z_z s/w_z + 1) over (s^2/w_p^2 + 2 z_p s/w_p + 1), static gain 1; frequencies [Hz], that of the zeros
/// may be infinite: then there are none.
template <class T>
Numerator<T> biquad(const T& zero_frequency, const T& zero_damping, const T& pole_frequency) {
  const T ratio = pole_frequency / zero_frequency;
  return {T{1}, T{2} * zero_damping * ratio, ratio * ratio};
}

/// A notch: 1 but for its neighbourhood, `depth` at the frequency (0: nothing passes there), damping z of the poles: it
/// is 2 z of the frequency wide, between the points where 1 - (1 - depth^2)/2 of the power passes.
template <class T>
Numerator<T> notch(const T& damping, const T& depth) {
  return {T{1}, T{2} * damping * depth, T{1}};
}

/// Coefficients, highest power of s first, of product (s - real) times product ((s - a)^2 + b^2), one factor per pair
/// a +- b i: what zeros and poles make.
inline std::vector<double> polynomial(std::span<const double> real, std::span<const double> pairs) {
  std::vector<double> c{1.0};
  const auto multiply = [&](std::span<const double> factor) {
    std::vector<double> product(c.size() + factor.size() - 1, 0.0);
    for (std::size_t i = 0; i < c.size(); ++i)
      for (std::size_t j = 0; j < factor.size(); ++j) product[i + j] += c[i] * factor[j];
    c = std::move(product);
  };
  for (const double root : real) multiply(std::vector<double>{1.0, -root});
  for (std::size_t k = 0; k + 1 < pairs.size(); k += 2)
    multiply(std::vector<double>{1.0, -2 * pairs[k], pairs[k] * pairs[k] + pairs[k + 1] * pairs[k + 1]});
  return c;
}

}  // namespace hysteron::second_order
