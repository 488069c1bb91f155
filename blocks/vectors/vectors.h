// Decides the blocks "mux", "demux" and "select": which elements a vector is made of. Changes no number: in a program
// each element becomes a pass of its own, so that it keeps its unit and depends on nothing else.
#pragma once

#include "engine/block/block.h"

namespace hysteron::blocks {

struct Mux {
  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    for (int i = 0; i < v.n_y; ++i) v.out[i] = v.u[i];
  }
};

struct Demux {
  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    for (int i = 0; i < v.n_y; ++i) v.out[i] = v.u[i];
  }
};

struct Select {
  enum Parameter { indices };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    for (int i = 0; i < v.n_y; ++i)
      v.out[i] = v.u[static_cast<int>(value_of(v.list(indices)[static_cast<std::size_t>(i)]))];
  }
};

Kernel mux_block();
Kernel demux_block();
Kernel select_block();

}  // namespace hysteron::blocks
