// Decides how three sensors at the rim of a rigid plate tell its displacement above three actuators that stand across
// from them. Does not decide the order of sensors and actuators beyond that: actuator i is opposite sensor i.
#pragma once

#include <array>

namespace hysteron::collocation {

/// y_i = S_i + (2/3) ((S_j + S_k)/2 - S_i) (r_1 + r_2)/r_1: sensors every 120 degrees at radius r_1, actuators at r_2
/// on the other side of the centre. Exact for a plate that stays flat. Source: thesis Eqs. 5.23 to 5.25.
inline std::array<double, 3> at_actuators(const std::array<double, 3>& sensors, double r_1, double r_2) {
  std::array<double, 3> y{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double others = (sensors[(i + 1) % 3] + sensors[(i + 2) % 3]) / 2;
    y[i] = sensors[i] + 2.0 / 3 * (others - sensors[i]) * (r_1 + r_2) / r_1;
  }
  return y;
}

/// What the sensors of that plate read: the same formula with the radii exchanged, since each stands across from the
/// other.
inline std::array<double, 3> at_sensors(const std::array<double, 3>& actuators, double r_1, double r_2) {
  return at_actuators(actuators, r_2, r_1);
}

}  // namespace hysteron::collocation
