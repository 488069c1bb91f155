#include "blocks/sampled/discrete_state_space.h"

namespace hysteron::blocks {

void DiscreteStateSpace::describe(Declaration& spec) {
  spec.name("discrete_state_space", "discrete-time linear state-space system with vector ports")
      .in_group("sampled")
      .linear();
  spec.law("x_(k+1) = A x_k + B u_k, y_k = C x_k + D u_k, x_0 = initial").from("definition");
  spec.remark(
      "The matrices are plain numbers for u in \"input_unit\" and y in \"output_unit\"; several units, one "
      "per element, are separated by commas: \"V, A\". They are valid for one sampling period only: "
      "another period needs other matrices.");
  describe_matrices(spec);
  spec.sampled();
}

Sizes DiscreteStateSpace::sizes(const Shape& shape) {
  Sizes s = sizes_of(shape);
  s.sampled_states = shape.rows_of("a");
  return s;
}

Kernel discrete_state_space_block() { return kernel<DiscreteStateSpace>(); }

}  // namespace hysteron::blocks
