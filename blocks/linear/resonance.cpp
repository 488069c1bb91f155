#include "blocks/linear/resonance.h"

namespace hysteron::blocks {

void Resonance::describe(BlockSpec<Resonance>& spec) {
  spec.name("resonance", "one resonance (second-order low-pass), static gain 1")
      .in_group("linear")
      .elementwise()
      .linear();
  spec.law("y'' + 2 damping w y' + w^2 y = w^2 u, w = 2 pi frequency").from("second-order low-pass, definition");
  spec.remark(
      "A stage of mass m on stiffness k has the frequency sqrt(k/m)/(2 pi); a load M lowers it by the "
      "factor sqrt(m/(m + M)).");
  spec.variation("stiffening", "duffing", {{"stiffening", "0"}});
  spec.input(&In<double>::u, "u", "$a", "the motion that drives the stage");
  spec.state(&State<double>::y, "y", "$a", "motion of the stage");
  spec.state(&State<double>::v, "v", "$a", "velocity of the stage over w");
  spec.output(&Out<double>::y, "y", "$a", "motion of the stage");
  spec.param(&Params<double>::frequency, "frequency", "Hz", "undamped natural frequency").positive();
  spec.param(&Params<double>::damping, "damping", "", "damping ratio; 1 = critically damped").not_negative();
}

Kernel resonance_block() { return kernel<Resonance>(); }

}  // namespace hysteron::blocks
