// Decides the blocks "dc_motor_with_presliding" and "pendulum_with_presliding": bodies that turn and have a block of
// their own, in bearings that stick and slip. Does not decide the laws: models/mechanics.
#pragma once

#include <algorithm>
#include <cstddef>

#include "blocks/mechanics/dc_motor.h"
#include "blocks/mechanics/mass_with_presliding.h"
#include "blocks/mechanics/pendulum.h"
#include "engine/block/block.h"

namespace hysteron::blocks {

template <class T>
DcMotor::In<T> braked(const DcMotor::In<T>& in, const T& torque) {
  return {in.voltage, in.load + torque};
}
template <class T>
Pendulum::In<T> braked(const Pendulum::In<T>& in, const T& torque) {
  return {in.torque - torque};
}

/// `Body`: a block of fixed size whose first two states are an angle and its rate, and which a torque may brake
/// (`braked`). Its numbers and states come first, then those of the elements.
template <class Body>
struct RotorInBearings {
  static constexpr int own = block_detail::count<double, typename Body::template Params<double>>();
  static constexpr int moving = block_detail::count<double, typename Body::template State<double>>();
  enum Parameter { contact_stiffness = own, slip_distance, excess, stribeck_velocity, contact_time };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    block_detail::fixed_output<Body, T>(v);
  }
  template <class T>
  static void derivative(const View<T>& v) {
    const block_detail::Arguments<Body, T> body(v);
    const T velocity = v.x[1];
    const T level = presliding::stribeck_level(v.parameter(excess), v.parameter(stribeck_velocity), velocity);
    const T held = held_by_elements<DahlElement, T>(v.list(contact_stiffness), v.list(slip_distance), level,
                                                    v.parameter(contact_time), v.x + moving, velocity, v.out + moving);
    block_detail::store<T>(Body::derivative(body.p, body.s, braked(body.in, held)), v.out);
  }
  /// The elements at rest hold nothing: as after a long decaying motion.
  static void rest(const View<double>& v) requires requires(const block_detail::Arguments<Body, double> a) {
    Body::rest(a.p, a.in);
  }
  {
    block_detail::fixed_rest<Body>(v);
    std::fill(v.out + moving, v.out + v.n_x, 0.0);
  }
  static void initial_states(const View<double>& v) {
    block_detail::fixed_initial_states<Body>(v);
    std::fill(v.out + moving, v.out + v.n_x, 0.0);
  }
};

Kernel dc_motor_with_presliding_block();
Kernel pendulum_with_presliding_block();

}  // namespace hysteron::blocks
