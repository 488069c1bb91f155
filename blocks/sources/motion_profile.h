// Decides the block "motion_profile": moves from place to place within limits. Does not decide how a move goes:
// models/sources/motion_profile.h.
#pragma once

#include <limits>
#include <string>

#include "engine/block/block.h"
#include "models/sources/motion_profile.h"

namespace hysteron::blocks {

struct MotionProfile {
  static constexpr bool uses_time = true;
  enum Parameter { positions, velocity, acceleration, jerk, profile, dwell, time, initial };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static std::string check(const View<double>& v);

  /// Move number `k`, where and when it begins.
  template <class T>
  struct Leg {
    motion_profile::Move<T> move;
    T from{0}, begin{0};
    bool is_last = true;
  };
  /// The leg on which `branch` lies: from its begin to the begin of the next.
  template <class T>
  static Leg<T> leg_at(const View<T>& v, double branch) {
    const auto to = v.list(positions);
    motion_profile::Limits<T> limits{v.parameter(velocity), v.parameter(acceleration), v.parameter(jerk)};
    if (v.choice(profile) == 1) limits.jerk = T{std::numeric_limits<double>::infinity()};
    Leg<T> leg;
    leg.from = v.parameter(initial);
    leg.begin = v.parameter(time);
    for (std::size_t k = 0;; ++k) {
      leg.move = motion_profile::move_of(T{to[k] - leg.from}, limits);
      leg.is_last = k + 1 == to.size();
      const T next = leg.begin + leg.move.duration() + v.parameter(dwell);
      if (leg.is_last || branch < value_of(next)) return leg;
      leg.from = to[k];
      leg.begin = next;
    }
  }
  /// Of the move, before -1, its seven pieces, behind 7; by the corners as next_breakpoint names them.
  template <class T>
  static int piece_of(const Leg<T>& leg, double branch) {
    int piece = -1;
    for (const T& corner : leg.move.meeting()) piece += branch >= value_of(T{leg.begin + corner}) ? 1 : 0;
    return piece;
  }
  template <class T>
  static void output(const View<T>& v) {
    const auto leg = leg_at(v, v.branch);
    const auto at = motion_profile::motion(leg.move, T{v.t - leg.begin}, piece_of(leg, v.branch));
    v.out[0] = leg.from + at.position;
    v.out[1] = at.velocity;
    v.out[2] = at.acceleration;
  }
  static double next_breakpoint(const View<double>& v);
};

Kernel motion_profile_block();

}  // namespace hysteron::blocks
