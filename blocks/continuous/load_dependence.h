// Decides the block "load_dependence": a force shortens an actuator and takes part of its stroke. Does not decide the
// force.
#pragma once

#include "engine/block/block.h"

namespace hysteron::blocks {

struct LoadDependence {
  template <class T>
  struct Params {
    T compliance, softening;
  };
  template <class T>
  struct In {
    T u, force;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<LoadDependence>& spec);
  template <class T>
  static Out<T> output(const Params<T>& p, const In<T>& in) {
    return {in.u * (1.0 - p.softening * in.force) - p.compliance * in.force};
  }
};

Kernel load_dependence_block();

}  // namespace hysteron::blocks
