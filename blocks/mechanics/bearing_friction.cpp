#include "blocks/mechanics/bearing_friction.h"

namespace hysteron::blocks {

void BearingFriction::describe(BlockSpec<BearingFriction>& spec) {
  spec.name("bearing_friction", "dry friction as an addition to the speed before a damping gain")
      .in_group("mechanics")
      .elementwise()
      .at("damping");
  spec.law(
          "y = u + level (1 + excess exp(-(u/stribeck_velocity)^2)) s, ds/dt = (u - |u| s)/slip_distance: times a "
          "damping b it is b u + F sgn(u), F = b level")
      .from("Dahl, AIAA J. 14 (1976) 1675; Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083");
  spec.remark(
      "Put it before the gain that is the damping (N s/m, N m s/rad) in a machine that is drawn from gains "
      "and integrators. If the mass is a block of its own, use mass_with_presliding or "
      "inertia_with_presliding.");
  spec.input(&In<double>::u, "u", "$a", "speed");
  spec.state(&State<double>::share, "share", "", "friction force relative to Coulomb friction, -1 .. 1");
  spec.output(&Out<double>::y, "y", "$a", "speed at which the damping alone would give the same force");
  spec.param(&Params<double>::level, "level", "$a", "Coulomb friction divided by the damping after the block")
      .linear()
      .not_negative();
  spec.param(&Params<double>::slip_distance, "slip_distance", "$a*s",
             "presliding distance: displacement from sticking to sliding")
      .positive();
  spec.param(&Params<double>::excess, "excess", "",
             "Stribeck effect: friction at low speed over Coulomb friction, minus 1")
      .optional("0")
      .not_negative();
  spec.param(&Params<double>::stribeck_velocity, "stribeck_velocity", "$a",
             "Stribeck velocity: speed over which the excess decays")
      .optional("0")
      .not_negative();
}

std::string BearingFriction::check(const Params<double>& p) {
  if (p.excess > 0 && !(p.stribeck_velocity > 0))
    return "an excess needs \"stribeck_velocity\", the speed over which it decays; write e.g. "
           "\"stribeck_velocity\": \"1 rad/s\"";
  return "";
}

Kernel bearing_friction_block() { return kernel<BearingFriction>(); }

}  // namespace hysteron::blocks
