// Decides the block "filtered_derivative": the rate of a signal, behind a lag. Does not decide the lag:
// models/continuous/creep.h.
#pragma once

#include "engine/block/block.h"
#include "models/continuous/creep.h"

namespace hysteron::blocks {

struct FilteredDerivative {
  template <class T>
  struct Params {
    T time;
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
  static void describe(BlockSpec<FilteredDerivative>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {creep::relaxation_rate(p.time, s.x, in.u)};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in) {
    return {creep::relaxation_rate(p.time, s.x, in.u)};
  }
  static State<double> rest(const Params<double>&, const In<double>& in) { return {in.u}; }
};

Kernel filtered_derivative_block();

}  // namespace hysteron::blocks
