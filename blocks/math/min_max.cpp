#include "blocks/math/min_max.h"

namespace hysteron::blocks {

void MinMax::describe(Declaration& d) {
  d.name("min_max", "the smallest or the largest of several signals").in_group("math").elementwise();
  d.law("y = max(u_1, u_2, ...) or min(u_1, u_2, ...)").from("definition");
  d.remark("It bends where another signal takes over, which is located. Against a number: \"saturation\".");
  d.inputs_any("in", "$a", "the signals");
  d.output("y", "$a", "the one that goes on");
  d.text("is", {"max", "min"}, "the largest or the smallest");
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
