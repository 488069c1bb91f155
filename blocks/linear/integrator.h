// Decides the block "integrator". Does not limit it.
#pragma once

#include "engine/block/block.h"

namespace hysteron::blocks {

struct Integrator {
  template <class T>
  struct Params {
    T initial;
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
  static void describe(BlockSpec<Integrator>& spec);
  template <class T>
  static Out<T> output(const Params<T>&, const State<T>& s) {
    return {s.x};
  }
  template <class T>
  static State<T> derivative(const Params<T>&, const State<T>&, const In<T>& in) {
    return {in.u};
  }
  static State<double> initial(const Params<double>& p) { return {p.initial}; }
};

Kernel integrator_block();

}  // namespace hysteron::blocks
