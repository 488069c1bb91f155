#include "blocks/mechanics/bearing_friction.h"

namespace hysteron::blocks {

void BearingFriction::describe(BlockSpec<BearingFriction>& spec) {
  spec.name("bearing_friction", "what a damping behind it turns into viscous and dry friction")
      .in_group("mechanics")
      .elementwise()
      .at("damping");
  spec.law(
          "y = u + level (1 + excess exp(-(u/stribeck_velocity)^2)) s, ds/dt = (u - |u| s)/slip_distance: times a "
          "damping b it is b u + F sgn(u), F = b level")
      .from("Dahl, AIAA J. 14 (1976) 1675; Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083");
  spec.remark(
      "Before the gain that is the damping (N s/m, N m s/rad) of a machine drawn from gains and integrators. Where a "
      "block moves the mass, mass_with_presliding and inertia_with_presliding say more.");
  spec.input(&In<double>::u, "u", "$a", "speed");
  spec.state(&State<double>::share, "share", "", "of the friction that the contact holds, -1 .. 1");
  spec.output(&Out<double>::y, "y", "$a", "the speed at which the damping alone would brake as much");
  spec.param(&Params<double>::level, "level", "$a", "dry friction of fast sliding, over the damping behind")
      .linear()
      .not_negative();
  spec.param(&Params<double>::slip_distance, "slip_distance", "$a*s", "way from sticking to sliding").positive();
  spec.param(&Params<double>::excess, "excess", "", "by how much more it holds at low speed")
      .optional("0")
      .not_negative();
  spec.param(&Params<double>::stribeck_velocity, "stribeck_velocity", "$a", "speed at which the excess is gone")
      .optional("0")
      .not_negative();
}

std::string BearingFriction::check(const Params<double>& p) {
  if (p.excess > 0 && !(p.stribeck_velocity > 0))
    return "an excess needs \"stribeck_velocity\", the speed at which it is gone; write e.g. \"stribeck_velocity\": "
           "\"1 rad/s\"";
  return "";
}

Kernel bearing_friction_block() { return kernel<BearingFriction>(); }

}  // namespace hysteron::blocks
