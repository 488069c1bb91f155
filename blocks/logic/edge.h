// Decides the block "edge": whether its input has become true since the last sampling instant.
#pragma once

#include "engine/block/block.h"
#include "models/logic/logic.h"

namespace hysteron::blocks {

struct EdgeDetector {
  template <class T>
  struct Params {
    T edge, period, offset;
  };
  template <class T>
  struct In {
    T u;
  };
  template <class T>
  struct Out {
    T y;
  };
  template <class T>
  struct State {
    T side;  // of the last instant; logic::start before the first
  };
  static void describe(BlockSpec<EdgeDetector>& spec);
  template <class T>
  static logic::Side side(const T& u) {
    return logic::is_true(u) ? logic::high : logic::low;
  }
  template <class T>
  static Out<T> output(const Params<T>& p, const State<T>& s, const In<T>& in) {
    const auto edge = logic::Edge(static_cast<int>(plain(p.edge)));
    return {logic::truth<T>(logic::is_edge(edge, logic::Side(static_cast<int>(plain(s.side))), side(in.u)))};
  }
  template <class T>
  static State<T> update(const Params<T>&, const State<T>&, const In<T>& in) {
    return {T(static_cast<double>(side(in.u)))};
  }
};

Kernel edge_block();

}  // namespace hysteron::blocks
