// Decides the block "pendulum". Does not decide its law: models/mechanics/pendulum.h.
#pragma once

#include "engine/block/block.h"
#include "models/mechanics/pendulum.h"

namespace hysteron::blocks {

struct Pendulum {
  template <class T>
  struct Params {
    T mass, length, inertia, damping, gravity, initial_angle, initial_speed;
  };
  template <class T>
  struct In {
    T torque;
  };
  template <class T>
  struct State {
    T angle, speed;
  };
  template <class T>
  struct Out {
    T angle, speed;
  };
  static void describe(BlockSpec<Pendulum>& spec);
  template <class T>
  static Out<T> output(const Params<T>&, const State<T>& s) {
    return {s.angle, s.speed};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in) {
    const pendulum::Params<T> law{p.mass, p.length, p.inertia, p.damping, p.gravity};
    return {s.speed, pendulum::acceleration(law, s.angle, s.speed, in.torque)};
  }
  static State<double> initial(const Params<double>& p) { return {p.initial_angle, p.initial_speed}; }
  static State<double> rest(const Params<double>& p, const In<double>& in) {
    return {pendulum::rest({p.mass, p.length, p.inertia, p.damping, p.gravity}, in.torque), 0};
  }
};

Kernel pendulum_block();

}  // namespace hysteron::blocks
