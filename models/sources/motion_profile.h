// Decides one move from point to point within limits of velocity, acceleration and jerk, in the shortest time: its
// corners and what it does between them. Does not decide when it begins nor which move follows.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "models/number.h"

namespace hysteron::motion_profile {

/// All positive; jerk may be infinite: then the acceleration jumps, and the velocity is a trapezoid.
template <class T>
struct Limits {
  T velocity{1};      ///< [m/s]
  T acceleration{1};  ///< [m/s^2]
  T jerk{1};          ///< [m/s^3]
};

/// The three times that make a move of seven pieces: jerk up, even acceleration, jerk down to the top speed, cruise,
/// and the same back to rest.
template <class T>
struct Move {
  T distance{0};      ///< [m]   signed
  T jerk_time{0};     ///< [s]   of each of the four pieces of jerk
  T even_time{0};     ///< [s]   of each of the two of even acceleration
  T cruise_time{0};   ///< [s]
  T acceleration{0};  ///< [m/s^2] reached, at most the limit; positive
  T top_speed{0};     ///< [m/s]   reached, at most the limit; positive

  T speeding_time() const { return T{2} * jerk_time + even_time; }     ///< [s] from rest to the top speed
  T duration() const { return T{2} * speeding_time() + cruise_time; }  ///< [s]
  static constexpr int corners = 8;
  /// The instants [s] since its begin at which its pieces meet, in order, the end included.
  std::array<T, corners> meeting() const {
    const T s = speeding_time(), end = duration(), brake = s + cruise_time;
    return {T{0}, jerk_time, T{jerk_time + even_time}, s, brake, T{brake + jerk_time}, T{end - jerk_time}, end};
  }
};

/// The move of a distance [m] in the shortest time within the limits, from rest to rest.
///
/// With t_j = a/j: the top speed v is reached if the distance is v (v/a + t_j) or more, then the cruise takes the rest.
/// Else the speed v_p is the root of d = v_p (v_p/a + t_j). Where a is not reached, v < a t_j, the same with v_p =
/// j t_j^2 and no even acceleration: t_j = sqrt(v/j), or the cubic root of d/(2 j).
/// Source: Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots (2008), section 3.4.
template <class T>
Move<T> move_of(const T& distance, const Limits<T>& limit) {
  using std::abs;
  using std::pow;
  using std::sqrt;
  Move<T> m;
  m.distance = distance;
  const T way = abs(distance);
  if (!(plain(way) > 0)) return m;
  const bool sharp = std::isinf(plain(limit.jerk));
  const T full = sharp ? T{0} : T{limit.acceleration / limit.jerk};  // time to the largest acceleration
  const bool reaches_acceleration = sharp || plain(limit.velocity) >= plain(T{limit.acceleration * full});
  const T to_speed = reaches_acceleration ? T{limit.velocity / limit.acceleration + full}
                                          : T{T{2} * sqrt(T{limit.velocity / limit.jerk})};
  if (plain(way) >= plain(T{limit.velocity * to_speed})) {
    m.top_speed = limit.velocity;
    m.cruise_time = way / limit.velocity - to_speed;
    m.jerk_time = reaches_acceleration ? full : T{T{0.5} * to_speed};
    m.even_time = reaches_acceleration ? T{limit.velocity / limit.acceleration - full} : T{0};
  } else if (reaches_acceleration && plain(way) >= plain(T{T{2} * limit.acceleration * full * full})) {
    // The root of v^2/a + v t_j = d, written so that nothing cancels; v/a is what both time pieces share.
    const T lag = limit.acceleration * full;
    m.top_speed = T{2} * way * limit.acceleration / (lag + sqrt(T{lag * lag + T{4} * way * limit.acceleration}));
    m.jerk_time = full;
    m.even_time = m.top_speed / limit.acceleration - full;
  } else {
    m.jerk_time = pow(T{way / (T{2} * limit.jerk)}, 1.0 / 3);
    m.top_speed = limit.jerk * m.jerk_time * m.jerk_time;
  }
  const bool reached = reaches_acceleration && plain(m.jerk_time) >= plain(full);
  m.acceleration = reached ? limit.acceleration : T{limit.jerk * m.jerk_time};
  if (!(plain(m.even_time) > 0)) m.even_time = T{0};  // rounding
  return m;
}

/// Where it is, how fast, how it speeds up.
template <class T>
struct Motion {
  T position{0};      ///< [m]
  T velocity{0};      ///< [m/s]
  T acceleration{0};  ///< [m/s^2]
};

namespace detail {

/// Motion of the first half of a move of unit sign, `t` since its begin [s], on piece 0 .. 3 (3: cruise).
template <class T>
Motion<T> first_half(const Move<T>& m, const T& t, int piece) {
  const T a = m.acceleration, tj = m.jerk_time;
  const T slope = plain(tj) > 0 ? T{a / tj} : T{0};  // the jerk
  if (piece == 0) return {slope * t * t * t / T{6}, slope * t * t / T{2}, slope * t};
  if (piece == 1) {  // as if it had speeded up evenly since half of the jerk's time, but for what that began with
    const T since = t - T{0.5} * tj;
    return {a * (T{0.5} * since * since + tj * tj / T{24}), a * since, a};
  }
  const T until = m.speeding_time() - t;  // seen from the top speed backwards
  const T before = m.top_speed * T{0.5} * m.speeding_time();
  if (piece == 2)
    return {before - m.top_speed * until + slope * until * until * until / T{6},
            m.top_speed - slope * until * until / T{2}, slope * until};
  return {before - m.top_speed * until, m.top_speed, T{0}};
}

}  // namespace detail

/// The motion `t` [s] since the begin of a move, on its piece -1 .. 7 (before it, the seven, behind it). The second
/// half is the first seen from the end, so that it ends exactly where it should.
template <class T>
Motion<T> motion(const Move<T>& m, const T& t, int piece) {
  if (piece < 0) return {};
  if (piece >= Move<T>::corners - 1) return {m.distance, T{0}, T{0}};
  const bool back = plain(m.distance) < 0;
  Motion<T> at;
  if (piece <= 3) {
    at = detail::first_half(m, t, piece);
  } else {
    const Motion<T> mirrored = detail::first_half(m, T{m.duration() - t}, 6 - piece);
    using std::abs;
    at = {abs(m.distance) - mirrored.position, mirrored.velocity, -mirrored.acceleration};
  }
  return back ? Motion<T>{-at.position, -at.velocity, -at.acceleration} : at;
}

/// The piece that holds `t` [s] since the begin: the one behind a corner there.
inline int piece_of(const Move<double>& m, double t) {
  const auto meeting = m.meeting();
  int piece = -1;
  for (const double corner : meeting) piece += t >= corner ? 1 : 0;
  return piece;
}

}  // namespace hysteron::motion_profile
