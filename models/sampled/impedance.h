// Decides how the capacitance of a stack is read from a ripple on its voltage: phasors of one window by joint least
// squares, capacitance from two phasors, polarisation from capacitances. Does not decide when a window begins.
#pragma once

#include <cmath>
#include <numbers>

namespace hysteron::impedance {

/// Signal in a window: Re((a + i b) e^(i w t)), t from the middle of the window.
template <class T>
struct Phasor {
  T a{0}, b{0};
};

/// Share of sample k of n in the phasor of a ripple of `cycles` whole periods per window, where 1, t, cos and sin are
/// fitted together by least squares. About the middle of the window cos is orthogonal to all others and sin to all but
/// t, so the fit has a closed form:
///
///   a = sum (2/n) cos_k x_k,   b = - sum (S_tt sin_k - S_ts t_k) x_k / (S_tt n/2 - S_ts^2),
///   S_tt = n (n^2 - 1)/12,   S_ts = sum t_k sin_k = -(-1)^cycles n/(2 sin(pi cycles/n))
///
/// A ramp of the drive leaves no trace. In a plain Fourier coefficient, which the thesis takes, a ramp of dV per window
/// is a ripple of amplitude dV/pi. Needs n > 4 and 0 < cycles < n/2.
inline Phasor<double> share(int k, int n, int cycles) {
  const double t = k - (n - 1) / 2.0, angle = 2 * std::numbers::pi * cycles / n;
  const double s_tt = n * (static_cast<double>(n) * n - 1) / 12;
  const double s_ts = (cycles % 2 == 0 ? -1 : 1) * n / (2 * std::sin(angle / 2));
  return {2.0 / n * std::cos(angle * t), -(s_tt * std::sin(angle * t) - s_ts * t) / (s_tt * n / 2 - s_ts * s_ts)};
}

/// The same by a plain Fourier coefficient, as the thesis takes it: a ramp counts as a ripple.
inline Phasor<double> fourier_share(int k, int n, int cycles) {
  const double angle = 2 * std::numbers::pi * cycles / n * (k - (n - 1) / 2.0);
  return {2.0 / n * std::cos(angle), -2.0 / n * std::sin(angle)};
}

/// Capacitance [F] from the phasors of current [A] and voltage [V] at the angular frequency w [rad/s]:
///
///   C = -(1/w) (A_I^2 + B_I^2)/(A_I B_V - A_V B_I)
///
/// A ripple measures the incremental capacitance dq/dV at the point where the drive is. Source: thesis Eqs. 3.6 to 3.8.
template <class T>
T capacitance(const T& w, const Phasor<T>& current, const Phasor<T>& voltage) {
  return -(current.a * current.a + current.b * current.b) / (w * (current.a * voltage.b - voltage.a * current.b));
}

/// eps_0 [F/m]. Source: CODATA 2018.
inline constexpr double vacuum = 8.8541878128e-12;

/// A stack: n plates of area A [m^2] and thickness d [m], side by side.
template <class T>
struct Stack {
  T layers{1}, area{1}, thickness{1};
};

/// dP/dE [F/m] of the material between the plates: C d/(N A) - eps_0.
template <class T>
T susceptibility(const Stack<T>& stack, const T& capacitance) {
  return capacitance * stack.thickness / (stack.layers * stack.area) - T{vacuum};
}

/// P = (C d/(N A) - eps_0) E [C/m^2]: the secant formula. Right only where P is proportional to E: with the incremental
/// capacitance of a ripple its loop turns the wrong way. Source: thesis Eq. 3.5 with alpha_D = 1.
template <class T>
T secant_polarisation(const Stack<T>& stack, const T& capacitance, const T& voltage) {
  return susceptibility(stack, capacitance) * voltage / stack.thickness;
}

/// Growth of P between two windows: the integral of (C d/(N A) - eps_0) dE by the trapezoidal rule.
/// Source: thesis Eq. 3.4 read as an incremental permittivity.
template <class T>
T polarisation_growth(const Stack<T>& stack, const T& capacitance_before, const T& capacitance_now,
                      const T& voltage_before, const T& voltage_now) {
  const T mean = (capacitance_before + capacitance_now) / T{2};
  return secant_polarisation(stack, mean, T{voltage_now - voltage_before});
}

}  // namespace hysteron::impedance
