// Decides the block "preisach": relays of a density that is even within cells, beside a linear part. Does not decide
// its law: models/hysteresis/preisach.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/hysteresis/preisach.h"

namespace hysteron::blocks {

struct Preisach {
  enum Parameter { levels, weights, gain, before };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static std::string check_memory(const View<double>& v);
  static void initial_memory(const View<double>& v);

  template <class T>
  static void advance(const View<T>& v) {
    preisach::advance(v.list(levels), v.memory(), v.u[0], v.out);
  }
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = v.parameter(gain) * v.u[0] + preisach::output(v.list(levels), v.list(weights), v.memory());
  }
  static void rows(const RowsView& r) {
    for (int lane = 0; lane < r.lanes; ++lane) rows_of(r, lane);
  }

 private:
  /// Kernels of weight zero, which nobody sees, are left where they are: a fit asks for the response to one weight
  /// after the other.
  static void rows_of(const RowsView& r, int lane);
};

Kernel preisach_block();

}  // namespace hysteron::blocks
