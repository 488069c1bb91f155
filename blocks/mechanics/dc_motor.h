// Decides the blocks "dc_motor" and "dc_winding". Does not decide their law: models/mechanics/dc_motor.h.
#pragma once

#include "engine/block/block.h"
#include "models/mechanics/dc_motor.h"

namespace hysteron::blocks {

struct DcMotor {
  template <class T>
  struct Params {
    T resistance, inductance, torque_constant, back_emf, inertia, damping, initial_angle, initial_velocity;
  };
  template <class T>
  struct In {
    T voltage, load;
  };
  template <class T>
  struct State {
    T angle, velocity, current;
  };
  template <class T>
  struct Out {
    T angle, velocity, current;
  };
  static void describe(BlockSpec<DcMotor>& spec);
  template <class T>
  static dc_motor::Params<T> law(const Params<T>& p) {
    return {p.resistance, p.inductance, p.torque_constant, value_of(p.back_emf) > 0 ? p.back_emf : p.torque_constant,
            p.inertia,    p.damping};
  }
  template <class T>
  static Out<T> output(const Params<T>&, const State<T>& s) {
    return {s.angle, s.velocity, s.current};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {s.velocity, dc_motor::acceleration(law(p), s.current, s.velocity, in.load),
            dc_motor::current_rate(law(p), in.voltage, s.current, s.velocity)};
  }
  static State<double> initial(const Params<double>& p) { return {p.initial_angle, p.initial_velocity, 0}; }
};

/// The winding alone, for rotors that have a block of their own.
struct DcWinding {
  template <class T>
  struct Params {
    T resistance, inductance, torque_constant, back_emf;
  };
  template <class T>
  struct In {
    T voltage, velocity;
  };
  template <class T>
  struct State {
    T current;
  };
  template <class T>
  struct Out {
    T torque, current;
  };
  static void describe(BlockSpec<DcWinding>& spec);
  template <class T>
  static dc_motor::Params<T> law(const Params<T>& p) {
    return {p.resistance, p.inductance, p.torque_constant, value_of(p.back_emf) > 0 ? p.back_emf : p.torque_constant,
            T{1},         T{0}};
  }
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s) {
    return {p.torque_constant * s.current, s.current};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {dc_motor::current_rate(law(p), in.voltage, s.current, in.velocity)};
  }
  static State<double> rest(const Params<double>& p, const In<double>& in) {
    return {(in.voltage - law(p).back_emf * in.velocity) / p.resistance};
  }
};

Kernel dc_motor_block();
Kernel dc_winding_block();

}  // namespace hysteron::blocks
