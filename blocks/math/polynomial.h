// Decides the block "polynomial": a static curve. Does not decide its law: models/math/polynomial.h.
#pragma once

#include <string>

#include "engine/block/block.h"
#include "models/math/polynomial.h"

namespace hysteron::blocks {

struct Polynomial {
  enum Parameter { coefficients, reference, lower, upper, about };

  static void describe(Declaration& d);
  static Sizes sizes(const Shape& shape);
  static std::string check(const View<double>& v);
  template <class T>
  static void output(const View<T>& v) {
    v.out[0] = polynomial::continued(v.list(coefficients), v.parameter(about), v.parameter(reference),
                                     v.parameter(lower), v.parameter(upper), v.u[0]);
  }
};

Kernel polynomial_block();

}  // namespace hysteron::blocks
