// Decides the blocks "gear", "belt" and "ball_screw": elastic connections of a turning shaft with what it drives. Does
// not decide their law: models/mechanics/transmission.h.
#pragma once

#include <array>
#include <numbers>

#include "engine/block/block.h"
#include "models/mechanics/transmission.h"

namespace hysteron::blocks {

/// What they have in common: how far the driver is ahead, what this gives, where it bends. `B` says the first, as
/// twist(p, in) -> {twist, rate, ratio}: ratio [driver per driven].
template <class T>
struct Twist {
  T twist, rate, ratio;
};
template <class B>
struct Transmission {
  template <class P>
  static auto contact(const P& p) {
    return transmission::Contact{p.stiffness, p.damping, p.gap};
  }
  template <class T, class P, class In>
  static std::array<T, 2> load_and_felt(const P& p, const In& in, const T& speed) {
    const Twist<T> at = B::twist(p, in);
    const T load = transmission::load(contact(p), at.twist, at.rate);
    return {load, transmission::felt(load, at.ratio, p.efficiency, speed)};
  }
  /// Without play and losses.
  template <class P>
  static bool is_linear_at(const P& p) {
    return p.gap == 0 && p.efficiency == 1;
  }
  /// The ends of the gap, the loss of contact at each; where there are losses, also a load of zero.
  template <class P, class In>
  static std::array<double, 5> kinks(const P& p, const In& in) {
    const Twist<double> at = B::twist(p, in);
    const double half = 0.5 * p.gap, damped = p.damping * at.rate;
    const double load = p.stiffness * at.twist + damped;
    const double loss = p.efficiency == 1 || half > 0 ? 1 : load;
    if (!(half > 0)) return {1, 1, 1, 1, loss};
    return {at.twist - half, at.twist + half, load - p.stiffness * half, load + p.stiffness * half, loss};
  }
};

struct Gear : Transmission<Gear> {
  template <class T>
  struct Params {
    T ratio, stiffness, damping, gap, efficiency;
  };
  template <class T>
  struct In {
    T angle_in, velocity_in, angle_out, velocity_out;
  };
  template <class T>
  struct Out {
    T torque_out, torque_in;
  };
  static void describe(BlockSpec<Gear>& spec);
  template <class T>
  static Twist<T> twist(const Params<T>& p, const In<T>& in) {
    return {in.angle_in / p.ratio - in.angle_out, in.velocity_in / p.ratio - in.velocity_out, p.ratio};
  }
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    const auto both = load_and_felt<T>(p, in, in.velocity_in);
    return {both[0], both[1]};
  }
};

template <class T>
struct ShaftAndCarriage {
  T angle, angular_velocity, position, velocity;
};
template <class T>
struct ForceAndTorque {
  T force, torque;
};

struct Belt : Transmission<Belt> {
  template <class T>
  struct Params {
    T radius, stiffness, damping, gap, efficiency;
  };
  template <class T>
  using In = ShaftAndCarriage<T>;
  template <class T>
  using Out = ForceAndTorque<T>;
  static void describe(BlockSpec<Belt>& spec);
  template <class T>
  static Twist<T> twist(const Params<T>& p, const In<T>& in) {
    return {p.radius * in.angle - in.position, p.radius * in.angular_velocity - in.velocity, T{1} / p.radius};
  }
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    const auto both = load_and_felt<T>(p, in, in.angular_velocity);
    return {both[0], both[1]};
  }
};

struct BallScrew : Transmission<BallScrew> {
  template <class T>
  struct Params {
    T pitch, stiffness, damping, gap, efficiency, pitch_error, wobble, wobble_phase;
  };
  template <class T>
  using In = ShaftAndCarriage<T>;
  template <class T>
  using Out = ForceAndTorque<T>;
  static void describe(BlockSpec<BallScrew>& spec);
  static bool is_linear_at(const Params<double>& p) { return Transmission::is_linear_at(p) && p.wobble == 0; }
  /// The nut is where the thread is: pitch (1 + pitch_error) angle/(2 pi) + wobble sin(angle + wobble_phase).
  template <class T>
  static Twist<T> twist(const Params<T>& p, const In<T>& in) {
    using std::cos;
    using std::sin;
    const T lead = p.pitch * (T{1} + p.pitch_error) / T{2 * std::numbers::pi}, turned = in.angle + p.wobble_phase;
    return {lead * in.angle + p.wobble * sin(turned) - in.position,
            (lead + p.wobble * cos(turned)) * in.angular_velocity - in.velocity, T{2 * std::numbers::pi} / p.pitch};
  }
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    const auto both = load_and_felt<T>(p, in, in.angular_velocity);
    return {both[0], both[1]};
  }
};

Kernel gear_block();
Kernel belt_block();
Kernel ball_screw_block();

}  // namespace hysteron::blocks
