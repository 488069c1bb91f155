// Decides the block "pi_controller", continuous. Does not limit its integral.
#pragma once

#include "engine/block/block.h"

namespace hysteron::blocks {

struct PiController {
  template <class T>
  struct Params {
    T kp, ki, initial;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct State {
    T x;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<PiController>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {p.kp * in.u + s.x};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>&, const In<T>& in) {
    return {p.ki * in.u};
  }
  static State<double> initial(const Params<double>& p) { return {p.initial}; }
};

Kernel pi_controller_block();

}  // namespace hysteron::blocks
