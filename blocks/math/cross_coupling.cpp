#include "blocks/math/cross_coupling.h"

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

void LateCrossCoupling::describe(BlockSpec<LateCrossCoupling>& spec) {
  spec.name("late_cross_coupling", "adds a share of another axis, behind a lag").in_group("continuous");
  spec.elementwise().linear();
  spec.law("y = u + coefficient w, time w' = other - w").from("definition");
  spec.remark("The frame or the cables between the axes pass on what is slow.");
  spec.input(&In<double>::u, "u", "$a", "this axis");
  spec.input(&In<double>::other, "other", "$b", "drive or motion of the other axis");
  spec.state(&State<double>::w, "w", "$b", "what arrives of the other axis");
  spec.output(&Out<double>::y, "y", "$a", "this axis as it moves");
  spec.param(&Params<double>::coefficient, "coefficient", "$a/$b", "motion of this axis per unit of the other")
      .linear();
  spec.param(&Params<double>::time, "time", "s", "time constant with which it arrives").positive();
}

Kernel cross_coupling_block() { return kernel<CrossCoupling>(); }
Kernel late_cross_coupling_block() { return kernel<LateCrossCoupling>(); }

}  // namespace hysteron::blocks
