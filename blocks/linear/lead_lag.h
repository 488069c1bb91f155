// Decides the block "lead_lag": one pole and one zero. Does not decide sections of second order: biquads.h.
#pragma once

#include "engine/block/block.h"
#include "models/linear/first_order.h"

namespace hysteron::blocks {

struct LeadLag {
  template <class T>
  struct Params {
    T gain, zero, pole;
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
  static void describe(BlockSpec<LeadLag>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {p.gain * first_order::lead(p.zero, p.pole, s.x, in.u)};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {first_order::rate(p.pole, s.x, in.u)};
  }
  static State<double> rest(const Params<double>&, const In<double>& in) { return {in.u}; }
};

Kernel lead_lag_block();

}  // namespace hysteron::blocks
