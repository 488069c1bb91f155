// Decides the deflection of elements that stick like springs and slip after a distance (Dahl): friction before sliding,
// and the hysteresis of a spring. Does not decide what they act on.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace hysteron::presliding {

/// Rate of an element's deflection z [m/s]: dz/dt = v - |v| z/distance. v [m/s] velocity, distance [m] > 0 after which
/// it slips; its force is stiffness z, at most stiffness distance. Rate independent; |z| stays below the distance.
/// Source: Dahl, AIAA J. 14 (1976) 1675-1682, exponent 1, force over stiffness.
template <class T>
T deflection_rate(const T& distance, const T& z, const T& velocity) {
  using std::abs;
  return velocity - abs(velocity) * z / distance;
}

/// The same for an element that yields at its distance and is elastic on the way back (Maxwell's slip with a rounded
/// corner): dz/dt = v (1 - (z/distance)^4) while the motion loads it, v while it unloads. With sharp corners elements
/// of several distances in parallel are a spring whose loops close at their turning points, as plays do (Masing's
/// rules), and so nearly do these; Dahl's do not. A higher exponent is a sharper corner, and stiffer to integrate.
/// Source: Iwan, J. Appl. Mech. 33 (1966) 893-900; transition as in Bouc-Wen's law with beta = gamma, n = 4.
template <class T>
T slip_rate(const T& distance, const T& z, const T& velocity) {
  if (!(z * velocity > 0)) return velocity;
  const T part = z / distance * (z / distance);
  return velocity * (1.0 - part * part);
}

/// How much more the element holds before it slides fast: 1 + e exp(-(v/v_s)^2); its slip distance is as much longer.
/// e = F_s/F_c - 1, v_s [m/s] > 0. Source: Canudas de Wit, Olsson, Astrom, Lischinsky, IEEE Trans. Autom. Control 40
/// (1995) 419-425.
template <class T>
T stribeck_level(const T& excess, const T& stribeck_velocity, const T& velocity) {
  using std::exp;
  const T ratio = velocity / stribeck_velocity;
  return 1.0 + excess * exp(-(ratio * ratio));
}

/// Rate [1/s] of the share s = z/distance of its largest force that an element holds which yields below sliding too:
/// ds/dt = (v - sqrt(v^2 + v_c^2) s)/distance. At a steady velocity s = v/sqrt(v^2 + v_c^2): the curve of a fluid that
/// flows before it yields, and Dahl's element for a crossover v_c = 0. |s| <= 1.
/// v [m/s], distance [m] > 0, v_c [m/s] >= 0.
/// Source: Dahl (as above), with Maxwell's relaxation at rest, time distance/v_c; curve of a damper with a yield force:
/// Spencer, Dyke, Sain, Carlson, J. Eng. Mech. 123 (1997) 230-238.
template <class T>
T yield_rate(const T& distance, const T& crossover, const T& share, const T& velocity) {
  using std::abs;
  using std::sqrt;
  const T speed = crossover > 0.0 ? T(sqrt(velocity * velocity + crossover * crossover)) : T(abs(velocity));
  return (velocity - speed * share) / distance;
}

/// The share [-] at which it settles at a steady velocity [m/s].
inline double sliding_share(double crossover, double velocity) {
  const double speed = std::hypot(velocity, crossover);
  return speed > 0 ? velocity / speed : 0;
}

/// Deflection [m] behind a motion by x [m] in one direction, from z: deflection_rate solved along the way.
inline double deflection_after(double distance, double x, double z = 0) {
  return z + (std::copysign(distance, x) - z) * -std::expm1(-std::fabs(x) / distance);
}

/// Of an element that yields (slip_rate), in its distances: the way from 0 on which its deflection grows to a share < 1
/// of the distance, (artanh + arctan)/2, and the share behind a way, its inverse.
inline double yielding_way(double share) { return 0.5 * (std::atanh(share) + std::atan(share)); }
class YieldingShare {
 public:
  static double behind(double way) {
    static const YieldingShare table;
    const double place = std::fabs(way) * per_one;
    if (!(place < last)) return std::isnan(way) ? way : std::copysign(1, way);  // 1 but for rounding
    const auto k = static_cast<int>(place);
    const double c = place - k;
    const auto& piece = table.pieces_[static_cast<std::size_t>(k)];
    // A cubic may pass 1 by its rounding: what is above its largest force would be relaxed at each step.
    return std::copysign(std::fmin(piece[0] + c * (piece[1] + c * (piece[2] + c * piece[3])), 1.0), way);
  }

 private:
  static constexpr int per_one = 64, last = 10 * per_one;
  std::array<std::array<double, 4>, last> pieces_{};  ///< Hermite's cubics, in powers of the place on each

  YieldingShare() {
    double a = 0;
    for (int k = 0; k < last; ++k) {
      const double b = share_behind(static_cast<double>(k + 1) / per_one, a);
      const auto slope = [](double s) { return (1 - s * s * s * s) / per_one; };
      const double rise = b - a, before = slope(a), behind = slope(b);
      pieces_[static_cast<std::size_t>(k)] = {a, before, 3 * rise - 2 * before - behind, before + behind - 2 * rise};
      a = b;
    }
  }

  /// Newton from the share a little before, where the way still hangs on the share but for rounding.
  static double share_behind(double way, double share) {
    for (int i = 0; i < 60 && share < 1; ++i) {
      const double move = (way - yielding_way(share)) * (1 - share * share * share * share);
      share = std::fmin(share + move, 1.0);
      if (std::fabs(move) < 1e-17) break;
    }
    return share;
  }
};

/// The share behind a way where it was above 1 (the distance grew shorter): the same law, (arcoth + arctan)/2, from the
/// other side. Newton in the logarithm of what is above 1: 1 plus what rounding leaves above it has no digits of that.
/// The way is convex there, and nearly linear near 1: from too far down Newton's steps come back without passing.
inline double relaxed_share(double share, double way) {
  if (share - 1 < 1e-7) return 1 + (share - 1) * std::exp(-4 * way);  // but for the square of what is above
  constexpr double nothing = -45;                                     // 1 + exp(nothing) is 1
  const auto way_of = [](double above) { return 0.25 * std::log1p(2 / above) + 0.5 * std::atan(1 + above); };
  const double whole = way_of(share - 1) + way;
  double logarithm = std::log(share - 1);
  for (int i = 0; i < 60; ++i) {
    const double above = std::exp(logarithm), part = 1 + above;
    const double next = std::fmax(nothing, logarithm + (way_of(above) - whole) * (1 + part) * (1 + part * part));
    const double moved = std::fabs(next - logarithm);
    logarithm = next;
    if (!(moved > 1e-12)) break;
  }
  return 1 + std::exp(logarithm);
}

/// An element at some deflection z [m]: where it stands behind a motion by x [m] in one direction.
class SlippingElement {
 public:
  SlippingElement(double distance, double z) : distance_(distance), per_distance_(1 / distance), z_(z) {}
  double z() const { return z_; }
  double distance() const { return distance_; }
  /// deflection_after, but for rounding of the distance.
  double after(double x) const {
    if (x == 0) return z_;
    const double held = std::copysign(distance_, x);
    return held - (held - z_) * std::exp(-std::fabs(x) * per_distance_);
  }
  void move(double x) { z_ = after(x); }

 private:
  double distance_, per_distance_, z_;
};

/// The same of one that yields: free on the way back to 0, then along its way. To 1e-8 of the distance.
class YieldingElement {
 public:
  YieldingElement(double distance, double z) : distance_(distance), per_distance_(1 / distance), z_(z) {}
  double z() const { return z_; }
  double distance() const { return distance_; }
  double after(double x) const {
    if (x == 0) return z_;
    const double way = std::fabs(x), held = std::fabs(z_);
    if (z_ * x < 0) {
      const double beyond = way - held;
      return beyond <= 0 ? z_ + x : std::copysign(distance_ * YieldingShare::behind(beyond * per_distance_), x);
    }
    if (held > distance_) return std::copysign(distance_ * relaxed_share(held / distance_, way * per_distance_), x);
    return std::copysign(distance_ * YieldingShare::behind(way_so_far() + way * per_distance_), x);
  }
  void move(double x) {
    if (x == 0) return;
    const double beyond = std::fabs(x) - std::fabs(z_);
    if ((z_ * x < 0 && beyond <= 0) || (z_ * x > 0 && std::fabs(z_) > distance_)) {
      *this = YieldingElement(distance_, after(x));
      return;
    }
    way_ = z_ * x < 0 ? beyond * per_distance_ : way_so_far() + std::fabs(x) * per_distance_;
    z_ = std::copysign(distance_ * YieldingShare::behind(way_), x);
  }

 private:
  /// From 0 to |z|, in distances. On its way back nobody asks.
  double way_so_far() const {
    if (way_ < 0) way_ = yielding_way(std::fabs(z_) / distance_);
    return way_;
  }

  double distance_, per_distance_, z_;
  mutable double way_ = -1;  ///< not known yet
};

}  // namespace hysteron::presliding
