#include "blocks/math/cross_coupling.h"

namespace hysteron::blocks {

void CrossCoupling::describe(BlockSpec<CrossCoupling>& spec) {
  spec.name("cross_coupling", "cross-coupling: adds a fraction of another axis")
      .in_group("math")
      .elementwise()
      .linear();
  spec.law("y = u + coefficient other").from("definition");
  spec.remark("Typical values: below 1 % for a good two-axis flexure stage, more for tube scanners.");
  spec.input(&In<double>::u, "u", "$a", "signal of this axis");
  spec.input(&In<double>::other, "other", "$b", "command or motion of the other axis");
  spec.output(&Out<double>::y, "y", "$a", "motion of this axis");
  spec.param(&Params<double>::coefficient, "coefficient", "$a/$b", "motion of this axis per unit of the other")
      .linear();
}

void LateCrossCoupling::describe(BlockSpec<LateCrossCoupling>& spec) {
  spec.name("late_cross_coupling", "cross-coupling with a lag: adds a slow fraction of another axis")
      .in_group("continuous");
  spec.elementwise().linear();
  spec.law("y = u + coefficient w, time w' = other - w").from("definition");
  spec.remark("It describes slow coupling, as through the frame or the cables between the axes.");
  spec.input(&In<double>::u, "u", "$a", "signal of this axis");
  spec.input(&In<double>::other, "other", "$b", "command or motion of the other axis");
  spec.state(&State<double>::w, "w", "$b", "lagged signal of the other axis");
  spec.output(&Out<double>::y, "y", "$a", "motion of this axis");
  spec.param(&Params<double>::coefficient, "coefficient", "$a/$b", "motion of this axis per unit of the other")
      .linear();
  spec.param(&Params<double>::time, "time", "s", "time constant of the coupling").positive();
}

Kernel cross_coupling_block() { return kernel<CrossCoupling>(); }
Kernel late_cross_coupling_block() { return kernel<LateCrossCoupling>(); }

}  // namespace hysteron::blocks
