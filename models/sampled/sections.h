// Decides a filter of second-order sections one behind the other: its output and its states from one instant to the
// next. Does not decide their coefficients (filter_design.h) nor when the instants are.
#pragma once

namespace hysteron::sections {

/// Y/U = (b0 + b1 z^-1 + b2 z^-2)/(1 + a1 z^-1 + a2 z^-2); b2 = a2 = 0: of first order.
struct Section {
  double b0 = 1, b1 = 0, b2 = 0, a1 = 0, a2 = 0;
};

/// y_k for the input u_k and the states w of one section, direct form II transposed.
/// Source: Oppenheim, Schafer, Discrete-Time Signal Processing, 3rd ed. (2010), chapter 6.
template <class T>
T output(const Section& s, const T* w, const T& u) {
  return s.b0 * u + w[0];
}

/// States of one section behind the instant, from its input and its output.
template <class T>
void update(const Section& s, const T* w, const T& u, const T& y, T* after) {
  after[0] = s.b1 * u - s.a1 * y + w[1];
  after[1] = s.b2 * u - s.a2 * y;
}

/// States of one section that has had the input u for ever; returns its output.
inline double rest(const Section& s, double u, double* w) {
  const double y = u * (s.b0 + s.b1 + s.b2) / (1 + s.a1 + s.a2);
  w[1] = s.b2 * u - s.a2 * y;
  w[0] = s.b1 * u - s.a1 * y + w[1];
  return y;
}

}  // namespace hysteron::sections
