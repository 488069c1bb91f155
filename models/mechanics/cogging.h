// Decides the torque by which the teeth of a motor draw its rotor to certain angles. Does not decide how it turns.
#pragma once

#include <cmath>

namespace hysteron::cogging {

/// Torque on the rotor [N m] at an angle [rad]: c cos(n angle) + s sin(n angle), c, s [N m], n periods a turn.
/// Source: Hanselman, Brushless Permanent Magnet Motor Design, 2nd ed. (2003), chapter 8, its first harmonic.
template <class T>
T torque(const T& cosine, const T& sine, const T& periods, const T& angle) {
  using std::cos;
  using std::sin;
  const T turned = periods * angle;
  return cosine * cos(turned) + sine * sin(turned);
}

/// A stable angle [rad] at which a torque from outside [N m], a spring of stiffness k [N m/rad] and the teeth balance:
/// without a spring the one nearest to 0, with one that to which 0 leads. Not a number where there is none.
inline double rest(double cosine, double sine, double periods, double stiffness, double outside) {
  const double size = std::hypot(cosine, sine);
  if (!(stiffness > 0)) {
    if (size == 0) return outside == 0 ? 0 : std::nan("");
    // size cos(n angle - phase) = -outside where it falls.
    const double turn = 2 * std::acos(-1.0), at = std::atan2(sine, cosine) + std::acos(-outside / size);
    return std::remainder(at, turn) / periods;
  }
  double angle = 0;
  for (int i = 0; i < 10000; ++i) {
    const double left = outside + torque(cosine, sine, periods, angle) - stiffness * angle;
    const double move = left / (stiffness + size * periods);  // never beyond the place where they balance
    angle += move;
    if (std::fabs(move) <= 1e-16 * std::fabs(angle)) break;
  }
  return angle;
}

}  // namespace hysteron::cogging
