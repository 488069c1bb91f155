// Decides the blocks "cross_coupling" and "late_cross_coupling": a share of another axis' signal is added, at once or
// behind a lag.
#pragma once

#include "engine/block/block.h"
#include "models/continuous/creep.h"

namespace hysteron::blocks {

struct CrossCoupling {
  template <class T>
  struct Params {
    T coefficient;
  };
  template <class T>
  struct In {
    T u, other;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<CrossCoupling>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    return {in.u + p.coefficient * in.other};
  }
};

struct LateCrossCoupling {
  template <class T>
  struct Params {
    T coefficient, time;
  };
  template <class T>
  struct In {
    T u, other;
  };
  template <class T>
  struct State {
    T w;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<LateCrossCoupling>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {in.u + p.coefficient * s.w};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {creep::relaxation_rate(p.time, s.w, in.other)};
  }
  static State<double> rest(const Params<double>&, const In<double>& in) { return {in.other}; }
};

Kernel cross_coupling_block();
Kernel late_cross_coupling_block();

}  // namespace hysteron::blocks
