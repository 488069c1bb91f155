// Decides a motor with brushes: its winding and its rotor. Does not decide what it drives.
#pragma once

namespace hysteron::dc_motor {

template <class T>
struct Params {
  T resistance{1};       ///< [Ohm]
  T inductance{1};       ///< [H]
  T torque_constant{1};  ///< [N m/A]
  T back_emf{1};         ///< [V s/rad], the same number in SI for a motor without losses in its iron
  T inertia{1};          ///< [kg m^2]
  T damping{0};          ///< [N m s/rad]
};

/// di/dt [A/s]: L di/dt = u - R i - K_e w. Source: Franklin, Powell, Emami-Naeini, Feedback Control of Dynamic Systems,
/// 7th ed. (2015), section 2.3.1.
template <class T>
T current_rate(const Params<T>& p, const T& voltage, const T& current, const T& speed) {
  return (voltage - p.resistance * current - p.back_emf * speed) / p.inductance;
}
/// dw/dt [rad/s^2]: J dw/dt = K_t i - b w - load.
template <class T>
T acceleration(const Params<T>& p, const T& current, const T& speed, const T& load) {
  return (p.torque_constant * current - p.damping * speed - load) / p.inertia;
}

}  // namespace hysteron::dc_motor
