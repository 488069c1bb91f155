// Decides the block "periodic_error": an error that comes again at the same positions. Does not decide its law:
// models/measurement/encoder.h.
#pragma once

#include "engine/block/block.h"
#include "models/measurement/encoder.h"

namespace hysteron::blocks {

struct PeriodicError {
  template <class T>
  struct Params {
    T period, cosine, sine, second_cosine, second_sine;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<PeriodicError>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    return {in.u + encoder::harmonic(1, p.cosine, p.sine, p.period, in.u) +
            encoder::harmonic(2, p.second_cosine, p.second_sine, p.period, in.u)};
  }
};

Kernel periodic_error_block();

}  // namespace hysteron::blocks
