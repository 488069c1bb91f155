// Decides the blocks "gain", "pass" and "calibration": straight lines. Does not decide units: wires and parameters do.
#pragma once

#include "engine/block/block.h"

namespace hysteron::blocks {

struct Gain {
  template <class T>
  struct Params {
    T gain;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Gain>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    return {p.gain * in.u};
  }
};

struct Pass {
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Pass>& spec);
  template <class T>
  static Out<T> output(const Nothing&, const In<T>& in) {
    return {in.u};
  }
};

struct Calibration {
  template <class T>
  struct Params {
    T gain, offset;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Calibration>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    return {p.gain * in.u + p.offset};
  }
};

Kernel gain_block();
Kernel pass_block();
Kernel calibration_block();

}  // namespace hysteron::blocks
