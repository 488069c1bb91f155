// Decides the block "logic": and, or, not of signals that are true or false.
#pragma once

#include "engine/block/block.h"
#include "models/logic/logic.h"

namespace hysteron::blocks {

struct LogicGate {
  enum Parameter { is };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    int how_many = 0;
    for (const T& u : v.inputs()) how_many += logic::is_true(u) ? 1 : 0;
    v.out[0] = logic::truth<T>(logic::joined(logic::Gate(v.choice(is)), how_many, v.n_u));
  }
  static void kinks(const View<double>& v);
};

Kernel logic_block();

}  // namespace hysteron::blocks
