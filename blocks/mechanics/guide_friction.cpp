#include "blocks/mechanics/guide_friction.h"

#include <fmt/format.h>

#include <cmath>

namespace hysteron::blocks {

void GuideFriction::describe(BlockSpec<GuideFriction>& spec) {
  spec.name("guide_friction", "friction of a guide on a wire that carries a motion: what it holds back is missing")
      .in_group("mechanics")
      .elementwise()
      .rate_independent()  // where the motion is fast; at rest nothing moves
      .at("motion");
  spec.law(
          "y = u - level s, ds/dt = (y' - |y'| s/g)/slip_distance, g = 1 + excess exp(-(u'/stribeck_velocity)^2): it "
          "sticks like a spring, slides after the slip distance")
      .from(
          "Dahl, AIAA J. 14 (1976) 1675; Canudas de Wit, Olsson, Astrom, Lischinsky, IEEE Trans. Autom. Control 40 "
          "(1995) 419");
  spec.remark("For an actuator without a mass of its own; level is the friction over the actuator's stiffness.");
  spec.remark("Rate independent for excess 0. Where a mass moves, mass_with_presliding says more.");
  spec.remark("A jump of the input is a fast ramp. Noise has no rate: it needs a lag in between.");
  spec.input(&In<double>::u, "u", "$a", "motion without friction");
  spec.state(&State<double>::share, "share", "", "of the friction of fast sliding");
  spec.output(&Out<double>::y, "y", "$a", "motion");
  spec.param(&Params<double>::level, "level", "$a", "what it holds back while it slides fast")
      .not_negative()
      .difference();
  spec.param(&Params<double>::slip_distance, "slip_distance", "$a", "way from sticking to sliding")
      .positive()
      .difference();
  spec.param(&Params<double>::excess, "excess", "", "by how much more it holds before it slides fast")
      .optional("0")
      .not_negative();
  spec.param(&Params<double>::stribeck_velocity, "stribeck_velocity", "$a/s", "speed of u at which the excess is gone")
      .optional("0")
      .not_negative();
  spec.param(&Params<double>::initial, "initial", "", "share held at the start").optional("0");
}

std::string GuideFriction::check(const Params<double>& p) {
  if (p.excess > 0 && !(p.stribeck_velocity > 0))
    return "an excess needs \"stribeck_velocity\", the speed at which it is gone; write e.g. \"stribeck_velocity\": "
           "\"1 mm/s\"";
  if (guide::may_jump(law(p)))
    return fmt::format(
        "level times excess is {{{} in slip_distance}}, not below slip_distance, {{slip_distance}}: such a guide jumps when it breaks away; "
        "take a longer slip distance, or a mass (mass_with_friction)",
        p.level * p.excess);
  if (std::fabs(p.initial) > 1 + p.excess)
    return fmt::format(
        "initial is {:.4g}, but a guide holds {:.4g} at most before it slides; write a share between -{:.4g} and "
        "{:.4g}",
        p.initial, 1 + p.excess, 1 + p.excess, 1 + p.excess);
  return "";
}

Kernel guide_friction_block() { return kernel<GuideFriction>(); }

}  // namespace hysteron::blocks
