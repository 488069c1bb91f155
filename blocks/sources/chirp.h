// Decides the block "chirp": a sine whose frequency moves. Does not decide its phase law: models/sources/signals.h.
#pragma once

#include "engine/block/block.h"
#include "models/sources/signals.h"

namespace hysteron::blocks {

struct Chirp {
  template <class T>
  struct Params {
    T amplitude, offset, from, to, duration, sweep, phase;
  };
  template <class T>
  struct Out {
    T y;
  };

  static void describe(BlockSpec<Chirp>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const Time<T>& time) {
    using std::sin;
    const auto sweep = value_of(p.sweep) == 0 ? signals::Sweep::linear : signals::Sweep::logarithmic;
    const int piece = time.branch < 0 ? -1 : time.branch < value_of(p.duration) ? 0 : 1;
    const T cycles = signals::chirp_cycles(time.t, p.from, p.to, p.duration, sweep, piece);
    return {p.offset + p.amplitude * sin(T{2 * signals::pi} * cycles + p.phase)};
  }
  static double next_breakpoint(const Params<double>& p, double t) {
    return t < 0 ? 0 : t < p.duration ? p.duration : signals::never;
  }
  static double shortest_period(const Params<double>& p) { return 1 / std::max(p.from, p.to); }
};

Kernel chirp_block();

}  // namespace hysteron::blocks
