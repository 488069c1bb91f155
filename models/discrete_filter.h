// Decides a linear filter in the shift operator z^-1: its output and its states from one instant to the next.
// Does not decide when the instants are.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace hysteron::discrete_filter {

/// Number of states for coefficients b_0 ... b_m, a_0 ... a_n.
constexpr std::size_t states(std::size_t numerator, std::size_t denominator) {
  return (numerator > denominator ? numerator : denominator) - 1;
}

/// One coefficient, over a_0; zero behind the end of the list.
template <class T>
T coefficient(std::span<const T> list, std::span<const T> denominator, std::size_t i) {
  return i < list.size() ? T{list[i] / denominator[0]} : T{0};
}

/// y_k for the input u_k: Y/U = (b_0 + b_1 z^-1 + ...)/(a_0 + a_1 z^-1 + ...), direct form II transposed.
/// Source: Oppenheim, Schafer, Discrete-Time Signal Processing, 3rd ed. (2010), chapter 6.
template <class T>
T output(std::span<const T> b, std::span<const T> a, std::span<const T> w, const T& u) {
  const T direct = coefficient(b, a, 0) * u;
  return w.empty() ? direct : T{w[0] + direct};
}

/// States behind the instant: w_i = w_(i+1) + b_i u - a_i y. `after` may not be `w`.
template <class T>
void update(std::span<const T> b, std::span<const T> a, std::span<const T> w, const T& u, T* after) {
  const T y = output(b, a, w, u);
  for (std::size_t i = 0; i < w.size(); ++i) {
    after[i] = coefficient(b, a, i + 1) * u - coefficient(a, a, i + 1) * y;
    if (i + 1 < w.size()) after[i] += w[i + 1];
  }
}

/// States in equilibrium with a constant input, whose output is u (sum b)/(sum a). Not a number where sum a = 0 (an
/// integrator) and the input is not zero.
inline void rest(std::span<const double> b, std::span<const double> a, double u, std::span<double> w) {
  double over = 0, under = 0;
  for (const double x : b) over += x;
  for (const double x : a) under += x;
  const double y = u == 0 ? 0.0 : under != 0 ? u * over / under : std::numeric_limits<double>::quiet_NaN();
  double behind = 0;
  for (std::size_t i = w.size(); i-- > 0;) {
    behind += coefficient(b, a, i + 1) * u - coefficient(a, a, i + 1) * y;
    w[i] = behind;
  }
}

}  // namespace hysteron::discrete_filter
