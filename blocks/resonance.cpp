#include "blocks/resonance.h"

namespace hysteron::blocks {

void Resonance::describe(BlockSpec<Resonance>& spec) {
  spec.name("resonance", "one lightly damped mode, gain one").in_group("continuous").elementwise().linear();
  spec.law("y'' + 2 damping w y' + w^2 y = w^2 u, w = 2 pi frequency").from("second-order low-pass, definition");
  spec.remark(
      "A stage of mass m on stiffness k has frequency sqrt(k/m)/(2 pi); a load M lowers it by sqrt(m/(m + M)).");
  spec.input(&In<double>::u, "u", "$a", "the motion that drives the stage");
  spec.state(&State<double>::y, "y", "$a", "motion of the stage");
  spec.state(&State<double>::v, "v", "$a", "its velocity over w");
  spec.output(&Out<double>::y, "y", "$a", "motion of the stage");
  spec.param(&Params<double>::frequency, "frequency", "Hz", "undamped natural frequency").positive();
  spec.param(&Params<double>::damping, "damping", "", "damping ratio; 1 does not ring").not_negative();
}

void AddedMode::describe(BlockSpec<AddedMode>& spec) {
  spec.name("mode", "one more mode beside what the signal does").in_group("continuous").elementwise().linear();
  spec.law("y = u + position (q - u) + velocity q'/w, q'' + 2 damping w q' + w^2 q = w^2 u, w = 2 pi frequency")
      .from("modal sum with two residues; Preumont, Vibration Control of Active Structures, 3rd ed. (2011), chapter 2");
  spec.remark("The static gain stays: position is the share of it that moves with the mode. 0 and 0 change nothing.");
  spec.input(&In<double>::u, "u", "$a", "the motion without the mode");
  spec.state(&State<double>::q, "q", "$a", "motion of the mode");
  spec.state(&State<double>::v, "v", "$a", "its velocity over w");
  spec.output(&Out<double>::y, "y", "$a", "the motion with the mode");
  spec.param(&Params<double>::frequency, "frequency", "Hz", "undamped natural frequency").positive();
  spec.param(&Params<double>::damping, "damping", "", "damping ratio").not_negative();
  spec.param(&Params<double>::position, "position", "", "residue: share of the mode's motion").linear();
  spec.param(&Params<double>::velocity, "velocity", "", "residue: share of its velocity over w").optional("0").linear();
}

Kernel mode_block() { return kernel<AddedMode>(); }
Kernel resonance_block() { return kernel<Resonance>(); }

}  // namespace hysteron::blocks
