#include "blocks/continuous/load_dependence.h"

namespace hysteron::blocks {

void LoadDependence::describe(BlockSpec<LoadDependence>& spec) {
  spec.name("load_dependence", "displacement of an actuator under a measured load force")
      .in_group("continuous")
      .elementwise()
      .at("core");
  spec.law("y = u (1 - softening force) - compliance force")
      .from(
          "spring and constant load on a piezo stack: Fleming, Leang, Design, Modeling and Control of Nanopositioning "
          "Systems (2014), chapter 2; PI Ceramic tutorial, forces and stiffness");
  spec.remark(
      "compliance shifts the position in proportion to the force; softening reduces the stroke, as a "
      "preload that changes the polarisation does.");
  spec.input(&In<double>::u, "u", "$a", "displacement without load");
  spec.input(&In<double>::force, "force", "N", "load force; positive values oppose positive displacement");
  spec.output(&Out<double>::y, "y", "$a", "displacement under load");
  spec.param(&Params<double>::compliance, "compliance", "$a/N", "compliance of the actuator, 1/stiffness").linear();
  spec.param(&Params<double>::softening, "softening", "1/N", "relative loss of stroke per newton").linear();
}

Kernel load_dependence_block() { return kernel<LoadDependence>(); }

}  // namespace hysteron::blocks
