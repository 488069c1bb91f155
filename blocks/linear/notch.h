// Decides the block "notch". Does not decide its law: models/linear/second_order.h.
#pragma once

#include "engine/block/block.h"
#include "models/linear/resonance.h"
#include "models/linear/second_order.h"

namespace hysteron::blocks {

struct Notch {
  template <class T>
  struct Params {
    T frequency, damping, depth;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct State {
    T q, v;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Notch>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {second_order::output(second_order::notch(p.damping, p.depth), p.damping, s.q, s.v, in.u)};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in) {
    const auto rate = resonance::rates(p.frequency, p.damping, s.q, s.v, in.u);
    return {rate.q, rate.v};
  }
  static State<double> rest(const Params<double>&, const In<double>& in) { return {in.u, 0}; }
};

Kernel notch_block();

}  // namespace hysteron::blocks
