// Decides the Maxwell resistive capacitor: elasto-plastic elements in charge, whose voltages add up. Does not decide
// what is in series with it.
#pragma once

#include <cstddef>
#include <span>

namespace hysteron::maxwell_capacitor {

/// u_H = sum (q - w_i)/C_i [V]: each element holds the charge q - w_i, at most its yield charge q_i, where w_i is the
/// two-sided play of radius q_i driven by q [C]. On the virgin branch du/dq falls by 1/C_i as q passes q_i.
/// Source: Goldfarb, Celanovic, IEEE Control Syst. 17 (1997) no. 3, 69-79; thesis Eq. 5.8.
template <class T>
T voltage(std::span<const T> elastances, std::span<const T> operators, const T& q) {
  T u{0};
  for (std::size_t i = 0; i < elastances.size(); ++i) u += elastances[i] * (q - operators[i]);
  return u;
}

/// Capacitance at the terminals while no element yields: H in series with C_T = C + T_q T_F/k, the capacitor beside a
/// transducer on a spring. S = sum 1/C_i.
///
///   C_eq = C_T/(1 + C_T S)
///
/// Source: thesis Eq. 5.9 as corrected: the printed C_T S/(C_T + S) adds a capacitance to an elastance.
template <class T>
T series_capacitance(const T& c_t, const T& elastance) {
  return c_t / (T{1} + c_t * elastance);
}

}  // namespace hysteron::maxwell_capacitor
