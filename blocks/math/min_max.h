// Decides the block "min_max": the smallest or largest of several signals.
#pragma once

#include "engine/block/block.h"

namespace hysteron::blocks {

struct MinMax {
  enum Parameter { is };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = v.u[first(v)];
  }
  static void kinks(const View<double>& v);

 private:
  /// Which input goes on; of equal ones the first.
  template <class T>
  static int first(const View<T>& v, int without = -1) {
    int best = without == 0 ? 1 : 0;
    for (int i = best + 1; i < v.n_u; ++i)
      if (i != without && (v.choice(is) == 0 ? v.u[i] > v.u[best] : v.u[i] < v.u[best])) best = i;
    return best;
  }
};

Kernel min_max_block();

}  // namespace hysteron::blocks
