// Decides the block "propeller". Does not decide its law: models/mechanics/propeller.h.
#pragma once

#include "engine/block/block.h"
#include "models/mechanics/propeller.h"

namespace hysteron::blocks {

struct Propeller {
  template <class T>
  struct Params {
    T thrust_coefficient, torque_coefficient, time, initial;
  };
  template <class T>
  struct In {
    T command;
  };
  template <class T>
  struct State {
    T speed;
  };
  template <class T>
  struct Out {
    T thrust, torque, speed;
  };
  static void describe(BlockSpec<Propeller>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s) {
    return {propeller::square_law(p.thrust_coefficient, s.speed), propeller::square_law(p.torque_coefficient, s.speed),
            s.speed};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {propeller::speed_rate(p.time, in.command, s.speed)};
  }
  static State<double> initial(const Params<double>& p) { return {p.initial}; }
  static State<double> rest(const Params<double>&, const In<double>& in) { return {in.command}; }
};

Kernel propeller_block();

}  // namespace hysteron::blocks
