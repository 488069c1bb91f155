// Decides the block "ageing": a gain that falls with the cycles it has seen. Does not decide its law:
// models/continuous/ageing.h.
#pragma once

#include "engine/block/block.h"
#include "models/continuous/ageing.h"

namespace hysteron::blocks {

struct Ageing {
  template <class T>
  struct Params {
    T per_decade, first, swing;
  };
  template <class T>
  struct In {
    T u, used;
  };
  template <class T>
  struct Memory {
    T extreme, direction, cycles;
  };
  template <class T>
  struct Out {
    T y;
  };
  static void describe(BlockSpec<Ageing>& spec);
  template <class T>
  static Memory<T> advance(const Params<T>& p, const Memory<T>& m, const In<T>& in) {
    const auto after = ageing::count<T>({m.extreme, m.direction, m.cycles}, p.swing, in.u);
    return {after.extreme, after.direction, after.cycles};
  }
  template <class T>
  static Out<T> output(const Params<T>& p, const Memory<T>& advanced, const In<T>& in) {
    return {in.u * ageing::gain(p.per_decade, p.first, T{in.used + advanced.cycles})};
  }
};

Kernel ageing_block();

}  // namespace hysteron::blocks
