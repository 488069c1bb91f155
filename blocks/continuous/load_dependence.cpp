#include "blocks/continuous/load_dependence.h"

namespace hysteron::blocks {

void LoadDependence::describe(BlockSpec<LoadDependence>& spec) {
  spec.name("load_dependence", "motion of an actuator under a measured force")
      .in_group("continuous")
      .elementwise()
      .at("core");
  spec.law("y = u (1 - softening force) - compliance force")
      .from(
          "spring and constant load on a piezo stack: Fleming, Leang, Design, Modeling and Control of Nanopositioning "
          "Systems (2014), chapter 2; PI Ceramic tutorial, forces and stiffness");
  spec.remark(
      "A constant force only shifts (compliance); a preload that changes the polarisation takes stroke (softening).");
  spec.input(&In<double>::u, "u", "$a", "motion without load");
  spec.input(&In<double>::force, "force", "N", "force against the motion");
  spec.output(&Out<double>::y, "y", "$a", "motion under the load");
  spec.param(&Params<double>::compliance, "compliance", "$a/N", "one over the stiffness").linear();
  spec.param(&Params<double>::softening, "softening", "1/N", "part of the stroke that a newton takes").linear();
}

Kernel load_dependence_block() { return kernel<LoadDependence>(); }

}  // namespace hysteron::blocks
