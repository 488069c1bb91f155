// Decides the level of a tank with an outlet and a brim: open, full, or pumped empty. Does not locate the transitions.
#pragma once

#include <algorithm>
#include <cmath>

namespace hysteron::tank {

enum Mode { open, full, empty };
enum class Outlet { linear, square_root, power };

/// How far a level passes brim or bottom before it counts [m]: open may then begin exactly there.
inline constexpr double film = 1e-9;

template <class T>
struct Params {
  T area{1};       ///< [m^2]
  T outlet{0};     ///< [m^3/s] flow through the outlet at the reference level
  T reference{1};  ///< [m]
  T height{1};     ///< [m] brim; may be infinite
  T exponent{1};   ///< of the level, in Outlet::power
};

/// Flow through the outlet [m^3/s] at a share h/h_r of the reference level: see outflow.
template <class T>
T outflow_at(Outlet law, const Params<T>& p, const T& share) {
  using std::pow;
  using std::sqrt;
  if (!(share > T{0})) return T{0};
  if (law == Outlet::power) return p.outlet * T{pow(share, p.exponent)};
  return p.outlet * (law == Outlet::linear ? share : T{sqrt(share)});
}

/// Flow through the outlet [m^3/s] at a level [m]: q_r h/h_r (a long narrow pipe), q_r sqrt(h/h_r) (an orifice) or
/// q_r (h/h_r)^n (what has of both, n between 1/2 and 1); none at h <= 0.
/// Source: Torricelli's law; Johansson, IEEE Trans. Control Syst. Technol. 8 (2000) 456-465 (four tanks).
template <class T>
T outflow(Outlet law, const Params<T>& p, const T& level) {
  return outflow_at(law, p, T{level / p.reference});
}

/// Inflow less outflow [m^3/s].
template <class T>
T net(Outlet law, const Params<T>& p, const T& level, const T& inflow) {
  return inflow - outflow(law, p, level);
}

/// dh/dt [m/s]: net/area where open; full and empty hold their level.
template <class T>
T rate(Outlet law, const Params<T>& p, Mode mode, const T& level, const T& inflow) {
  return mode == open ? T{net(law, p, level, inflow) / p.area} : T{0};
}

/// What runs over the brim [m^3/s].
template <class T>
T overflow(Outlet law, const Params<T>& p, Mode mode, const T& inflow) {
  return mode == full ? net(law, p, p.height, inflow) : T{0};
}

/// Positive = the mode may stay: room to brim or bottom [m] where open, surplus [m^3/s] while full, demand of an
/// outside pump [m^3/s] while empty.
template <class T>
T guard(Outlet law, const Params<T>& p, Mode mode, const T& level, const T& inflow) {
  using std::min;
  if (mode == full) return net(law, p, p.height, inflow);
  if (mode == empty) return -inflow;
  return min(T{p.height - level}, level) + T{film};
}

/// What follows a mode whose guard is not positive, never the mode itself; the level is then held_level.
template <class T>
Mode next(Mode mode, const T& level) {
  if (mode != open) return open;
  return level > T{0} ? full : empty;
}
template <class T>
T held_level(const Params<T>& p, const T& level) {
  using std::max;
  using std::min;
  return max(T{0}, min(p.height, level));
}

/// Level [m] and what has been spilled [m^3] behind a step of h [s] while the inflow [m^3/s] moves in a straight line:
/// one Runge-Kutta step of the open tank (Kutta, Z. Math. Phys. 46 (1901) 435-453), held between bottom and brim. What
/// is above the brim is spilled; when it was reached is known to within the step only.
struct Filled {
  double level = 0, spilled = 0;
};
inline Filled after(Outlet law, const Params<double>& p, const Filled& before, double from, double to, double h) {
  const double per_area = 1 / p.area, per_reference = 1 / p.reference;  // divisions would be half of the time
  const auto slope = [&](double level, double inflow) {
    return (inflow - outflow_at(law, p, held_level(p, level) * per_reference)) * per_area;
  };
  const double x = before.level, middle = 0.5 * (from + to);
  const double k1 = slope(x, from), k2 = slope(x + 0.5 * h * k1, middle), k3 = slope(x + 0.5 * h * k2, middle),
               k4 = slope(x + h * k3, to);
  const double moved = x + h / 6 * (k1 + 2 * (k2 + k3) + k4);
  return {held_level(p, moved), before.spilled + p.area * std::max(0.0, moved - p.height)};
}

/// Level [m] at which in- and outflow balance, at most the brim; not a number without an outlet.
inline double rest(Outlet law, const Params<double>& p, double inflow) {
  if (inflow <= 0) return 0;
  const double ratio = inflow / p.outlet;
  const double share = law == Outlet::linear        ? ratio
                       : law == Outlet::square_root ? ratio * ratio
                                                    : std::pow(ratio, 1 / p.exponent);
  return std::min(p.height, p.reference * share);
}

}  // namespace hysteron::tank
