#include "blocks/cross_coupling.h"

namespace hysteron::blocks {

void CrossCoupling::describe(BlockSpec<CrossCoupling>& spec) {
  spec.name("cross_coupling", "adds a share of another axis").in_group("math").elementwise().linear();
  spec.law("y = u + coefficient other").from("definition");
  spec.remark("A good two-axis flexure stage stays below 1 %, tube scanners do not.");
  spec.input(&In<double>::u, "u", "$a", "this axis");
  spec.input(&In<double>::other, "other", "$b", "drive or motion of the other axis");
  spec.output(&Out<double>::y, "y", "$a", "this axis as it moves");
  spec.param(&Params<double>::coefficient, "coefficient", "$a/$b", "motion of this axis per unit of the other")
      .linear();
}

Kernel cross_coupling_block() { return kernel<CrossCoupling>(); }

}  // namespace hysteron::blocks
