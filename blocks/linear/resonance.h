// Decides the block "resonance", one lightly damped mode with gain one. For stages whose parts are known by their
// frequency only: with mass and stiffness known, mass_spring_damper says more; for modes beside what a signal does
// anyway, modes.h. Does not decide how a mode moves: models/linear/resonance.h.
#pragma once

#include "engine/block/block.h"
#include "models/linear/resonance.h"

namespace hysteron::blocks {

struct Resonance {
  template <class T>
  struct Params {
    T frequency, damping;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct State {
    T y, v;  ///< v = y'/w: of the size of y at the resonance
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Resonance>& spec);
  template <class T>
  static Out<T> output(const Params<T>&, const State<T>& s) {
    return {s.y};
  }
  template <class T>
  static State<T> derivative(const Params<T>& p, const State<T>& s, const In<T>& in) {
    const auto rate = resonance::rates(p.frequency, p.damping, s.y, s.v, in.u);
    return {rate.q, rate.v};
  }
  static State<double> rest(const Params<double>&, const In<double>& in) { return {in.u, 0}; }
};

Kernel resonance_block();

}  // namespace hysteron::blocks
