// Decides the block "trigonometry": functions of angles, and angles from their functions.
#pragma once

#include "engine/block/block.h"
#include "engine/block/instance.h"
#include "models/math/expression_code.h"

namespace hysteron::blocks {

struct Trigonometry {
  enum Parameter { function };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static void units(const Shape& shape, InstanceUnits& units);
  static expression::Op operation(int choice) { return expression::Op(static_cast<int>(expression::Op::sin) + choice); }
  template <class T>
  static void output(const View<T>& v) {
    const T &a = v.u[0], &b = v.u[v.n_u - 1];
    expression::with_operation(operation(v.choice(function)), [&](auto op) {
      if constexpr (op >= expression::Op::sin && op <= expression::Op::tanh)
        v.out[0] = expression::value<op()>(a, b, b);
    });
  }
  static void kinks(const View<double>& v);
};

Kernel trigonometry_block();

}  // namespace hysteron::blocks
