// Decides the block "state_space": any linear time-invariant system with vectors at its ports, and what its sampled
// sibling shares with it. Does not know what its states mean.
#pragma once

#include "engine/block/block.h"

namespace hysteron::blocks {

/// What systems of four matrices share, whatever their states do: ports, parameters, units, output.
struct Matrices {
  enum Parameter { a, b, c, d, initial, input_unit, output_unit };

  /// Ports, states and parameters.
  static void describe_matrices(Declaration& spec);
  /// Without the number of states.
  static Sizes sizes_of(const Shape& shape);
  static void prepare(const View<double>& v);
  static void initial_states(const View<double>& v);

  template <class T>
  static void output(const View<T>& v) {
    const bool direct = !v.list(d).empty();  // without D the input may not be known yet when the output is asked for
    const Scale scale{v.c, v.n_u};
    for (int r = 0; r < v.n_y; ++r) {
      T y = times(v.list(c).data() + r * v.n_x, v.x, v.n_x);
      if (direct)
        for (int k = 0; k < v.n_u; ++k)
          y += v.list(d)[static_cast<std::size_t>(r * v.n_u + k)] * scale.input(k, v.u[k]);
      v.out[r] = scale.output(r, y);
    }
  }

 protected:
  /// A x + B u
  template <class T>
  static void moved(const View<T>& v) {
    const Scale scale{v.c, v.n_u};
    for (int r = 0; r < v.n_x; ++r) {
      T rate = times(v.list(a).data() + r * v.n_x, v.x, v.n_x);
      for (int k = 0; k < v.n_u; ++k)
        rate += v.list(b)[static_cast<std::size_t>(r * v.n_u + k)] * scale.input(k, v.u[k]);
      v.out[r] = rate;
    }
  }

 private:
  /// The constants: scale and offset to SI of every input, then of every output.
  struct Scale {
    const double* c;
    int inputs;
    template <class T>
    T input(int k, const T& si) const {
      return (si - c[2 * k + 1]) / c[2 * k];
    }
    template <class T>
    T output(int k, const T& number) const {
      return c[2 * (inputs + k)] * number + c[2 * (inputs + k) + 1];
    }
  };
  template <class T>
  static T times(const T* row, const T* x, int n) {
    T sum{0};
    for (int k = 0; k < n; ++k) sum += row[k] * x[k];
    return sum;
  }
};

struct StateSpace : Matrices {
  static void describe(Declaration& spec);
  static Sizes sizes(const Shape& shape);
  /// A x = -B u; not a number where A is singular.
  static void rest(const View<double>& v);

  template <class T>
  static void derivative(const View<T>& v) {
    moved(v);
  }
};

Kernel state_space_block();

}  // namespace hysteron::blocks
