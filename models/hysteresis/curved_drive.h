// Decides how a drive is bent before operators see it: a rising curve through both ends of a range, given by its slopes
// there. Does not decide which operators follow it.
#pragma once

namespace hysteron::curved_drive {

/// Units for a drive in V; any other works alike.
template <class T>
struct Params {
  T lower{0}, upper{1};  ///< [V] ends of the range, lower < upper, both of which the curve keeps
  T slope_at_lower{1};   ///< [-] 0 .. 3, of the straight line's; 1 at both ends is the straight line itself
  T slope_at_upper{1};   ///< [-] 0 .. 3
};

/// Within these slopes the curve rises all the way. Source: Fritsch, Carlson, SIAM J. Numer. Anal. 17 (1980) 238-246.
inline constexpr double steepest = 3;

/// Hermite's cubic from lower to upper, straight on beyond, less what it says of no drive: curved(0) = 0.
/// Operators that follow it are the generalized Prandtl-Ishlinskii model with one envelope for both branches. Source:
/// Al Janaideh, Rakheja, Su, IEEE/ASME Trans. Mechatronics 16 (2011) 734-744.
template <class T>
T curved(const Params<T>& p, const T& u) {
  const T range = p.upper - p.lower;
  const auto at = [&](const T& value) {
    const T x = (value - p.lower) / range;
    if (x < 0.0) return T(p.slope_at_lower * x);
    if (x > 1.0) return T(1.0 + p.slope_at_upper * (x - 1.0));
    const T rest = 1.0 - x;
    return T(x * (rest * rest * p.slope_at_lower + x * (3.0 - 2.0 * x - rest * p.slope_at_upper)));
  };
  return range * (at(u) - at(T{0}));
}

}  // namespace hysteron::curved_drive
