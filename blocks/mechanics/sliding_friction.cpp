#include "blocks/mechanics/sliding_friction.h"

namespace hysteron::blocks {

void SlidingFriction::describe(BlockSpec<SlidingFriction>& spec) {
  spec.name("sliding_friction", "friction on a wire that carries a speed").in_group("mechanics").elementwise();
  spec.law("y = u + level s, ds/dt = (u - sqrt(u^2 + crossover^2) s)/slip_distance")
      .from("Dahl, AIAA J. 14 (1976) 1675; Spencer, Dyke, Sain, Carlson, J. Eng. Mech. 123 (1997) 230");
  spec.remark(
      "A dashpot behind it makes a force of both: damping times level is the friction while it slides. Where a mass "
      "moves freely, mass_with_friction and mass_with_presliding say more.");
  spec.input(&In<double>::u, "u", "$a", "speed");
  spec.state(&State<double>::share, "share", "", "of its largest force, -1 .. 1");
  spec.output(&Out<double>::y, "y", "$a", "speed and friction, as the speed that a dashpot would need for it");
  spec.param(&Params<double>::level, "level", "$a", "friction while it slides, over the damping behind").linear();
  spec.param(&Params<double>::slip_distance, "slip_distance", "$a*s", "way from sticking to sliding").positive();
  spec.param(&Params<double>::crossover, "crossover", "$a", "speed below which it flows like a fluid, 0 = it sticks")
      .optional("0")
      .not_negative();
}

Kernel sliding_friction_block() { return kernel<SlidingFriction>(); }

}  // namespace hysteron::blocks
