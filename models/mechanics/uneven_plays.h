// Decides plays that are not equally strong everywhere, and whose corners are round: where each stands, and how much it
// passes on there. Does not decide what they move. Sharp and even ones: play.h.
#pragma once

#include <cmath>

namespace hysteron::uneven_plays {

/// The range over which the strength of a play varies; beyond, it stays as it is at the ends. lower < upper, in the
/// unit of the input [u].
template <class T>
struct Range {
  T lower{-1}, upper{1};
};

/// What a play passes on per step of its own, at the ends of the range and in its middle: Bernstein's parabola, which
/// is negative nowhere where these are not. [y/u]
template <class T>
struct Strength {
  T at_lower{0}, in_middle{0}, at_upper{0};
};

/// Strength where the play stands at w.
template <class T>
T strength(const Range<T>& range, const Strength<T>& s, const T& w) {
  const T part = (w - range.lower) / (range.upper - range.lower);
  if (!(part > 0.0)) return s.at_lower;
  if (!(part < 1.0)) return s.at_upper;
  const T rest = 1.0 - part;
  return rest * rest * s.at_lower + 2.0 * part * rest * s.in_middle + part * part * s.at_upper;
}

/// What it has passed on since it stood at 0: the integral of the strength. [y]
/// One play of each width, and a strength along its place, is a density of Preisach's over width and middle of the
/// relays' loops; a play of even strength is the operator of Prandtl and Ishlinskii. Source: Brokate, Sprekels,
/// Hysteresis and Phase Transitions (1996), chapter 2 (Preisach's operator as a superposition of plays).
template <class T>
T passed_on(const Range<T>& range, const Strength<T>& s, const T& w) {
  const T width = range.upper - range.lower;
  const auto from_lower = [&](const T& place) {
    const T part = (place - range.lower) / width;
    if (!(part > 0.0)) return T(s.at_lower * part);
    const T third = (s.at_lower + s.in_middle + s.at_upper) / 3.0;
    if (!(part < 1.0)) return T(third + s.at_upper * (part - 1.0));
    return T(part * (s.at_lower +
                     part * (s.in_middle - s.at_lower + part * (s.at_lower - 2.0 * s.in_middle + s.at_upper) / 3.0)));
  };
  return width * (from_lower(w) - from_lower(T{0}));
}

/// passed_on() of one play whose numbers stay: they are worked out once.
class PassedOn {
 public:
  PassedOn(const Range<double>& range, const Strength<double>& s)
      : lower_(range.lower),
        width_(range.upper - range.lower),
        per_width_(1 / width_),
        at_lower_(width_ * s.at_lower),
        rise_(width_ * (s.in_middle - s.at_lower)),
        bend_(width_ * (s.at_lower - 2 * s.in_middle + s.at_upper) / 3),
        all_(width_ * (s.at_lower + s.in_middle + s.at_upper) / 3),
        at_upper_(width_ * s.at_upper),
        from_lower_to_0_(from_lower(0)) {}
  double operator()(double w) const { return from_lower(w) - from_lower_to_0_; }

 private:
  double from_lower(double w) const {
    const double part = (w - lower_) * per_width_;
    if (!(part > 0)) return at_lower_ * part;
    if (!(part < 1)) return all_ + at_upper_ * (part - 1);
    return part * (at_lower_ + part * (rise_ + part * bend_));
  }

  double lower_, width_, per_width_, at_lower_, rise_, bend_, all_, at_upper_, from_lower_to_0_;
};

/// [-] Over this part of its half width a play comes to be carried along: a sharp corner would be a jump of its rate,
/// which no integrator passes quickly. What it lags more by is gone after a few times that.
inline constexpr double corner = 0.05;

/// Rate of the place w of a play of half width r [u] that an input u of this rate carries along.
template <class T>
T rate(const T& radius, const T& w, const T& u, const T& rate_of_u) {
  const T gap = rate_of_u > 0.0 ? u - w : w - u;
  const T touching = (gap - radius) / (corner * radius) + 1.0;
  if (!(touching > 0.0)) return T{0};
  return touching < 1.0 ? T(touching * rate_of_u) : rate_of_u;
}

/// The same law behind a move of the input in one direction: where the play stands that was at w. What does not hang
/// on how far the input moves is worked out once.
class Carried {
 public:
  Carried() = default;
  /// From the input `before`, in the direction of side (1 or -1).
  Carried(double radius, double w, double before, double side) : radius_(radius), w_(w), side_(side) {
    const double round = corner * radius, to_the_wall = radius - side * (before - w), way = to_the_wall - round;
    free_ = way > 0 ? way : 0;
    left_ = way > 0 ? round : to_the_wall;
  }
  /// Behind `distance` in that direction nothing has moved yet.
  bool stays(double distance) const { return !(distance > free_); }
  /// Behind `distance` in that direction, at the input u.
  double at(double distance, double u) const {
    if (stays(distance)) return w_;
    // What is left of the corner falls by 1/e with every `round` of the way; behind forty of them nothing is.
    const double round = corner * radius_, beyond = distance - free_;
    if (!(left_ > 0)) return u - side_ * (radius_ - left_);
    return u - side_ * (beyond < 40 * round ? radius_ - left_ * std::exp(-beyond / round) : radius_);
  }

 private:
  double radius_ = 0, w_ = 0, side_ = 1, free_ = 0, left_ = 0;
};

inline double after(double radius, double w, double before, double u) {
  return Carried(radius, w, before, u < before ? -1 : 1).at(std::fabs(u - before), u);
}

}  // namespace hysteron::uneven_plays
