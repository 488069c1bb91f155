#include "blocks/mechanics/sliding_friction.h"

namespace hysteron::blocks {

void SlidingFriction::describe(BlockSpec<SlidingFriction>& spec) {
  spec.name("sliding_friction", "friction as an addition to the speed before a dashpot")
      .in_group("mechanics")
      .elementwise();
  spec.law("y = u + level s, ds/dt = (u - sqrt(u^2 + crossover^2) s)/slip_distance")
      .from("Dahl, AIAA J. 14 (1976) 1675; Spencer, Dyke, Sain, Carlson, J. Eng. Mech. 123 (1997) 230");
  spec.remark(
      "A damping gain after the block gives the total force: the friction while sliding is damping times "
      "level. For a freely moving mass use mass_with_friction or mass_with_presliding.");
  spec.input(&In<double>::u, "u", "$a", "speed");
  spec.state(&State<double>::share, "share", "", "friction force relative to its largest value, -1 .. 1");
  spec.output(&Out<double>::y, "y", "$a", "speed at which the dashpot alone would give the same force");
  spec.param(&Params<double>::level, "level", "$a", "friction while sliding divided by the damping after the block")
      .linear();
  spec.param(&Params<double>::slip_distance, "slip_distance", "$a*s",
             "presliding distance: displacement from sticking to sliding")
      .positive();
  spec.param(&Params<double>::crossover, "crossover", "$a", "speed below which the friction is viscous; 0 = it sticks")
      .optional("0")
      .not_negative();
}

Kernel sliding_friction_block() { return kernel<SlidingFriction>(); }

}  // namespace hysteron::blocks
