// Decides synchronous machines with permanent magnets: currents and torque of three phases in the frame of the rotor,
// and of a stepper in its two phases. Does not turn the rotor.
#pragma once

#include <cmath>

#include "models/electrical/winding.h"

namespace hysteron::synchronous_machine {

/// Two currents: along the magnets (d) and across (q), or of the phases a and b of a stepper [A].
template <class T>
struct Currents {
  T first{}, second{};
};

/// In the frame of the rotor, amplitudes of the phase quantities (Clarke's factor 2/3).
template <class T>
struct Machine {
  T resistance{1};    ///< [ohm] of a phase
  T inductance_d{1};  ///< [H]
  T inductance_q{1};  ///< [H]
  T flux{0};          ///< [V s] of the magnets, linked with a phase
  T pole_pairs{1};
};

/// L_d i_d' = v_d - R i_d + p w L_q i_q, L_q i_q' = v_q - R i_q - p w (L_d i_d + psi); w [rad/s] mechanical.
/// Source: Krishnan, Permanent Magnet Synchronous and Brushless DC Motor Drives (2010), section 3.
template <class T>
Currents<T> rates(const Machine<T>& m, const Currents<T>& voltage, const T& speed, const Currents<T>& i) {
  const T w = m.pole_pairs * speed;
  return {
      winding::current_rate(m.resistance, m.inductance_d, voltage.first, T{-(w * m.inductance_q * i.second)}, i.first),
      winding::current_rate(m.resistance, m.inductance_q, voltage.second, T{w * (m.inductance_d * i.first + m.flux)},
                            i.second)};
}

/// 3/2 p (psi i_q + (L_d - L_q) i_d i_q) [N m]. Power is kept: torque times w is what the voltages give less the losses
/// and what goes into the inductances. Source: the same.
template <class T>
T torque(const Machine<T>& m, const Currents<T>& i) {
  return T{1.5} * m.pole_pairs * i.second * (m.flux + (m.inductance_d - m.inductance_q) * i.first);
}

/// A hybrid stepper of two phases.
template <class T>
struct Stepper {
  T resistance{1};  ///< [ohm] of a phase
  T inductance{1};  ///< [H] of a phase
  T constant{1};    ///< [N m/A] = [V s]
  T teeth{50};      ///< of the rotor; four full steps a tooth: 50 make steps of 1.8 deg
  T detent{0};      ///< [N m] amplitude of the torque without current
};

/// L i_a' = v_a - R i_a + K w sin(N theta), L i_b' = v_b - R i_b - K w cos(N theta); theta [rad], w [rad/s].
/// Source: Kenjo, Sugawara, Stepping Motors and Their Microprocessor Controls, 2nd ed. (1994), chapter 4.
template <class T>
Currents<T> rates(const Stepper<T>& m, const Currents<T>& voltage, const T& angle, const T& speed,
                  const Currents<T>& i) {
  using std::cos;
  using std::sin;
  const T at = m.teeth * angle, emf = m.constant * speed;
  return {winding::current_rate(m.resistance, m.inductance, voltage.first, T{-(emf * sin(at))}, i.first),
          winding::current_rate(m.resistance, m.inductance, voltage.second, T{emf * cos(at)}, i.second)};
}

/// K (i_b cos(N theta) - i_a sin(N theta)) - T_d sin(4 N theta) [N m]. Source: the same.
template <class T>
T torque(const Stepper<T>& m, const T& angle, const Currents<T>& i) {
  using std::cos;
  using std::sin;
  const T at = m.teeth * angle;
  return m.constant * (i.second * cos(at) - i.first * sin(at)) - m.detent * sin(T{4.0 * at});
}

}  // namespace hysteron::synchronous_machine
