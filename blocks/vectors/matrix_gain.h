// Decides the block "matrix_gain": every output a weighted sum of all inputs. Has no dynamics: state_space has.
#pragma once

#include "engine/block/block.h"

namespace hysteron::blocks {

struct MatrixGain {
  enum Parameter { matrix };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  template <class T>
  static void output(const View<T>& v) {
    const T* m = v.list(matrix).data();
    for (int r = 0; r < v.n_y; ++r) {
      T sum{0};
      for (int c = 0; c < v.n_u; ++c) sum += *m++ * v.u[c];
      v.out[r] = sum;
    }
  }
};

Kernel matrix_gain_block();

}  // namespace hysteron::blocks
