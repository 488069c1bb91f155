#include "blocks/mechanics/mass_with_friction.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void MassWithFriction::describe(BlockSpec<MassWithFriction>& spec) {
  spec.name("mass_with_friction", "mass with dry friction (true sticking), driven by a force");
  spec.law(
          "sliding: mass dv/dt = force - damping v - stiffness x - sign(v) (coulomb + (breakaway - coulomb) "
          "exp(-|v/stribeck_velocity|^stribeck_exponent)); sticking: v = 0 until |force - stiffness x| reaches "
          "breakaway")
      .from("Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083-1138");
  spec.remark("Three modes: sticking, sliding forwards, sliding backwards. A sticking mass does not creep.");
  spec.remark(
      "With coulomb and breakaway 0 the block equals mass_spring_damper. Presliding (elastic contact) is "
      "not included.");
  describe_motion(spec).optional("0");
  describe_dry_friction(spec);
  describe_start(spec);
  describe_beyond_linear(spec);
}

void describe_dry_friction(Declaration& d, const MotionWords& words) {
  d.parameter("coulomb", words.cause_unit, "Coulomb friction (at high speed)").not_negative();
  d.parameter("breakaway", words.cause_unit,
              std::string(words.cause) + " at which sticking ends, at least coulomb; 0 = coulomb (1 + excess)")
      .optional("0")
      .not_negative();
  d.parameter("stribeck_velocity", words.speed_unit(),
              "Stribeck velocity, over which the friction falls from breakaway to coulomb; 0 = at once")
      .optional("0")
      .not_negative();
  d.parameter("rest_speed", words.speed_unit(), "speed below which a reversal of motion counts as standing still")
      .optional(std::string("1 n") + words.speed_unit())
      .positive();
  d.parameter("excess", "", "breakaway/coulomb - 1, used if breakaway is 0").optional("0").not_negative();
  d.parameter("stribeck_exponent", "", "exponent of the Stribeck curve: 2 = Gaussian, 1 = exponential")
      .optional("2")
      .positive();
}

std::string MassWithFriction::check(const Params<double>& p) {
  if (p.breakaway >= p.coulomb || p.breakaway == 0) return "";
  return "breakaway, {breakaway}, is below coulomb, {coulomb}; give at least coulomb, or leave it out";
}

void IntegratorWithFriction::describe(BlockSpec<IntegratorWithFriction>& spec) {
  using P = Params<double>;
  spec.name("integrator_with_friction", "integrates an acceleration to a speed, against dry friction (true sticking)")
      .in_group("mechanics")
      .elementwise();
  spec.law(
          "sliding: dy/dt = u - sign(y) level (1 + excess exp(-|y/stribeck_velocity|^stribeck_exponent)); sticking: y = "
          "0 until |u| reaches level (1 + excess)")
      .from("Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083-1138");
  spec.remark(
      "For a body that is drawn as sums, gains and integrators. level is the force of the friction over the mass (its "
      "torque over the inertia); where a block \"mass_with_friction\" or \"inertia_with_friction\" fits, it says the "
      "force itself.");
  spec.remark("With level 0 the block equals integrator.");
  spec.input(&In<double>::u, "u", "$a", "the acceleration without the friction");
  spec.state(&State<double>::x, "x", "$a*s", "the speed");
  spec.output(&Out<double>::y, "y", "$a*s", "the speed");
  spec.param(&P::level, "level", "$a", "Coulomb friction (at high speed), as the acceleration that it takes away")
      .not_negative();
  spec.param(&P::excess, "excess", "", "breakaway over Coulomb friction, less one").optional("0").not_negative();
  spec.param(&P::stribeck_velocity, "stribeck_velocity", "$a*s",
             "Stribeck velocity, over which the friction falls from breakaway to level; 0 = at once")
      .optional("0")
      .not_negative();
  spec.param(&P::stribeck_exponent, "stribeck_exponent", "",
             "exponent of the Stribeck curve: 2 = Gaussian, 1 = exponential")
      .optional("2")
      .positive();
  spec.param(&P::initial, "initial", "$a*s", "initial speed").optional("0");
}

Kernel mass_with_friction_block() { return kernel<MassWithFriction>(); }
Kernel integrator_with_friction_block() { return kernel<IntegratorWithFriction>(); }

}  // namespace hysteron::blocks
