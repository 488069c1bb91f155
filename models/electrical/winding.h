// Decides how the current of a winding moves. Does not decide what turns or moves in it.
#pragma once

namespace hysteron::winding {

/// di/dt [A/s] of L di/dt = voltage - R i - emf; R [ohm], L [H], voltages [V]. Source: Kirchhoff's voltage law.
template <class T>
T current_rate(const T& resistance, const T& inductance, const T& voltage, const T& emf, const T& current) {
  return (voltage - emf - resistance * current) / inductance;
}

}  // namespace hysteron::winding
