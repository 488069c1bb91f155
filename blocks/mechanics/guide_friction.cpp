#include "blocks/mechanics/guide_friction.h"

#include <fmt/format.h>

#include <cmath>

namespace hysteron::blocks {

void GuideFriction::describe(BlockSpec<GuideFriction>& spec) {
  spec.name("guide_friction", "friction of a guide, as lost motion of an actuator")
      .in_group("mechanics")
      .elementwise()
      .rate_independent()  // where the motion is fast; at rest nothing moves
      .at("motion");
  spec.law(
          "y = u - level s, ds/dt = (y' - |y'| s/g)/slip_distance, g = 1 + excess "
          "exp(-(u'/stribeck_velocity)^2): elastic while sticking, sliding after the slip distance")
      .from(
          "Dahl, AIAA J. 14 (1976) 1675; Canudas de Wit, Olsson, Astrom, Lischinsky, IEEE Trans. Autom. Control 40 "
          "(1995) 419");
  spec.remark(
      "For an actuator whose mass is negligible; level is the friction force divided by the actuator "
      "stiffness.");
  spec.remark("Rate-independent for excess 0. For a guide with a moving mass use mass_with_presliding.");
  spec.remark("A jump of the input is treated as a fast ramp. Noise has no rate: it needs a lag in between.");
  spec.input(&In<double>::u, "u", "$a", "motion without friction");
  spec.state(&State<double>::share, "share", "", "friction force relative to Coulomb friction");
  spec.output(&Out<double>::y, "y", "$a", "motion with friction");
  spec.param(&Params<double>::level, "level", "$a",
             "lost motion while sliding fast: Coulomb friction over actuator stiffness")
      .not_negative()
      .difference();
  spec.param(&Params<double>::slip_distance, "slip_distance", "$a",
             "presliding distance: displacement from sticking to sliding")
      .positive()
      .difference();
  spec.param(&Params<double>::excess, "excess", "",
             "Stribeck effect: friction at low speed over Coulomb friction, minus 1")
      .optional("0")
      .not_negative();
  spec.param(&Params<double>::stribeck_velocity, "stribeck_velocity", "$a/s",
             "Stribeck velocity: rate of u over which the excess decays")
      .optional("0")
      .not_negative();
  spec.param(&Params<double>::initial, "initial", "",
             "initial friction force relative to Coulomb friction, -(1 + excess) .. 1 + excess")
      .optional("0");
}

std::string GuideFriction::check(const Params<double>& p) {
  if (p.excess > 0 && !(p.stribeck_velocity > 0))
    return "an excess needs \"stribeck_velocity\", the speed over which it decays; write e.g. "
           "\"stribeck_velocity\": \"1 mm/s\"";
  if (guide::may_jump(law(p)))
    return fmt::format(
        "level times excess is {{{} in slip_distance}}, not below slip_distance, {{slip_distance}}: such a guide jumps when it breaks away; "
        "take a longer slip distance, or a mass (mass_with_friction)",
        p.level * p.excess);
  if (std::fabs(p.initial) > 1 + p.excess)
    return fmt::format(
        "initial is {:.4g}, but the guide slides beyond {:.4g}; write a value between -{:.4g} and {:.4g}", p.initial,
        1 + p.excess, 1 + p.excess, 1 + p.excess);
  return "";
}

Kernel guide_friction_block() { return kernel<GuideFriction>(); }

}  // namespace hysteron::blocks
