// Decides what a propeller or fan makes of its speed. Does not drive it.
#pragma once

#include <cmath>

namespace hysteron::propeller {

/// Thrust [N] or torque [N m]: coefficient times w |w|, w [rad/s]. Source: Beard, McLain, Small Unmanned Aircraft
/// (2012), section 4.3, at rest in the air.
template <class T>
T square_law(const T& coefficient, const T& speed) {
  using std::abs;
  return coefficient * speed * abs(speed);
}

/// dw/dt [rad/s^2]: a speed controller and the inertia of the rotor follow the command with one time constant [s].
template <class T>
T speed_rate(const T& time, const T& command, const T& speed) {
  return (command - speed) / time;
}

}  // namespace hysteron::propeller
