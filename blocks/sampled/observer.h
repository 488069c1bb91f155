// Decides the blocks "observer" (Luenberger's) and "kalman_filter": a model that runs beside the plant and is pulled
// towards what is measured. Does not decide the gain of the second: kalman_gain.h.
#pragma once

#include <string>

#include "engine/block/block.h"

namespace hysteron::blocks {

/// What both share. Constants: the gain row by row, then scale and offset to SI of every input, measurement and state.
struct PulledModel {
  enum Parameter { a, b, c, d, initial, input_unit, output_unit, state_unit, first_of_own };

  static void describe_model(Declaration& spec);
  static Sizes sizes_of(const Shape& shape);
  static void note_units(const View<double>& v, double* c);
  static void initial_states(const View<double>& v);

  /// The estimate before what is measured at this instant: nothing acts at once.
  template <class T>
  static void output(const View<T>& v) {
    const Units units(v);
    for (int r = 0; r < v.n_x; ++r) v.out[r] = units.to_si(units.inputs + units.measured + r, v.x[r]);
  }
  template <class T>
  static void update(const View<T>& v) {
    const Units units(v);
    const int n = v.n_x;
    const auto entry = [&](int matrix, int row, int columns, int column) {
      return v.list(matrix)[static_cast<std::size_t>(row * columns + column)];
    };
    for (int r = 0; r < n; ++r) {
      v.out[r] = T{0};
      for (int k = 0; k < n; ++k) v.out[r] += entry(a, r, n, k) * v.x[k];
      for (int k = 0; k < units.inputs; ++k) v.out[r] += entry(b, r, units.inputs, k) * units.number(k, v.u[k]);
    }
    for (int i = 0; i < units.measured; ++i) {
      T lacks = units.number(units.inputs + i, v.u[units.inputs + i]);
      for (int k = 0; k < n; ++k) lacks -= entry(c, i, n, k) * v.x[k];
      if (!v.list(d).empty())
        for (int k = 0; k < units.inputs; ++k) lacks -= entry(d, i, units.inputs, k) * units.number(k, v.u[k]);
      for (int r = 0; r < n; ++r) v.out[r] += v.c[r * units.measured + i] * lacks;
    }
  }

 private:
  struct Units {
    int inputs, measured;
    const double* scale;  ///< scale and offset per input, measurement, state
    template <class T>
    explicit Units(const View<T>& v)
        : inputs(static_cast<int>(v.list(b).size()) / v.n_x), measured(v.n_u - inputs), scale(v.c + v.n_x * measured) {}
    template <class T>
    T number(int i, const T& si) const {
      return (si - scale[2 * i + 1]) / scale[2 * i];
    }
    template <class T>
    T to_si(int i, const T& number) const {
      return scale[2 * i] * number + scale[2 * i + 1];
    }
  };
};

struct Observer : PulledModel {
  enum Own { gain = first_of_own };
  static void describe(Declaration& spec);
  static Sizes sizes(const Shape& shape);
  static void prepare(const View<double>& v);
};

struct KalmanFilter : PulledModel {
  enum Own { process_noise = first_of_own, measurement_noise };
  static void describe(Declaration& spec);
  static Sizes sizes(const Shape& shape);
  static void prepare(const View<double>& v);
  static std::string check(const View<double>& v);
};

Kernel observer_block();
Kernel kalman_filter_block();

}  // namespace hysteron::blocks
