#include "blocks/math/min_max.h"

namespace hysteron::blocks {

void MinMax::describe(Declaration& d) {
  d.name("min_max", "minimum or maximum of several signals").in_group("math").elementwise();
  d.law("y = max(u_1, u_2, ...) or min(u_1, u_2, ...)").from("definition");
  d.remark(
      "It has a kink where another signal takes over; these instants are located. To limit by a constant "
      "use \"saturation\".");
  d.inputs_any("in", "$a", "the signals");
  d.output("y", "$a", "the smallest or largest signal");
  d.text("is", {"max", "min"}, "which one is selected");
}

Sizes MinMax::sizes(const Shape& shape) {
  Sizes s;
  s.kinks = shape.inputs > 1 ? shape.inputs : 0;
  return s;
}

/// Of each signal: by how much it is above the best of the others.
void MinMax::kinks(const View<double>& v) {
  for (int i = 0; v.n_u > 1 && i < v.n_u; ++i) v.out[i] = v.u[i] - v.u[first(v, i)];
}

Kernel min_max_block() { return kernel<MinMax>(); }

}  // namespace hysteron::blocks
