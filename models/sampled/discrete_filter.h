// Decides a linear filter in the shift operator z^-1: its output and its states from one instant to the next.
// Does not decide when the instants are.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

namespace hysteron::discrete_filter {

/// Y/U = z^-delay (b_0 + b_1 z^-1 + ...)/(a_0 + a_1 z^-1 + ...); a_0 is not zero.
template <class T>
struct Coefficients {
  std::span<const T> numerator, denominator;
  std::size_t delay = 0;

  T b(std::size_t i) const {
    return i >= delay && i - delay < numerator.size() ? T{numerator[i - delay] / denominator[0]} : T{0};
  }
  T a(std::size_t i) const { return i < denominator.size() ? T{denominator[i] / denominator[0]} : T{0}; }
};

/// Number of states for so many coefficients (delay counted with the numerator).
constexpr std::size_t states(std::size_t numerator, std::size_t denominator) {
  return std::max(numerator, denominator) - 1;
}

/// y_k for the input u_k, direct form II transposed. With a delay u_k has no influence.
/// Source: Oppenheim, Schafer, Discrete-Time Signal Processing, 3rd ed. (2010), chapter 6.
template <class T>
T output(const Coefficients<T>& f, std::span<const T> w, const T& u) {
  const T direct = f.b(0) * u;
  return w.empty() ? direct : T{w[0] + direct};
}

/// States behind the instant: w_i = w_(i+1) + b_i u - a_i y. `after` may not be `w`.
template <class T>
void update(const Coefficients<T>& f, std::span<const T> w, const T& u, T* after) {
  const T y = output(f, w, u);
  for (std::size_t i = 0; i < w.size(); ++i) {
    after[i] = f.b(i + 1) * u - f.a(i + 1) * y;
    if (i + 1 < w.size()) after[i] += w[i + 1];
  }
}

/// States in equilibrium with a constant input, whose output is u (sum b)/(sum a). Not a number where sum a = 0 (an
/// integrator) and the input is not zero.
inline void rest(const Coefficients<double>& f, double u, std::span<double> w) {
  double over = 0, under = 0;
  for (const double x : f.numerator) over += x;
  for (const double x : f.denominator) under += x;
  const double y = u == 0 ? 0.0 : under != 0 ? u * over / under : std::numeric_limits<double>::quiet_NaN();
  double behind = 0;
  for (std::size_t i = w.size(); i-- > 0;) {
    behind += f.b(i + 1) * u - f.a(i + 1) * y;
    w[i] = behind;
  }
}

}  // namespace hysteron::discrete_filter
