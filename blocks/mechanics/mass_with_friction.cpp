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

Kernel mass_with_friction_block() { return kernel<MassWithFriction>(); }

}  // namespace hysteron::blocks
