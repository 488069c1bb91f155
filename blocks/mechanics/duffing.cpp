#include "blocks/mechanics/duffing.h"

namespace hysteron::blocks {

void Duffing::describe(BlockSpec<Duffing>& spec) {
  spec.name("duffing", "one resonance on a nonlinear spring (Duffing), gain 1 of small motions")
      .in_group("mechanics")
      .elementwise();
  spec.law("y''/w^2 + 2 damping y'/w + y + quadratic y^2 + stiffening y^3 + quintic y^5 = u, w = 2 pi frequency")
      .from("Duffing's oscillator; Nayfeh, Mook, Nonlinear Oscillations (1979)");
  spec.remark(
      "With the last three 0 the block equals resonance. A negative stiffening softens the spring: then keep |y| below "
      "sqrt(1/(3 |stiffening|)).");
  spec.input(&In<double>::u, "u", "$a", "what drives it, as the motion that it would make of small drives at rest");
  spec.state(&State<double>::y, "y", "$a", "motion");
  spec.state(&State<double>::rate, "rate", "$a/s", "velocity");
  spec.output(&Out<double>::y, "y", "$a", "motion");
  spec.param(&Params<double>::frequency, "frequency", "Hz", "undamped natural frequency of small motions").positive();
  spec.param(&Params<double>::damping, "damping", "", "damping ratio of small motions").not_negative();
  spec.param(&Params<double>::stiffening, "stiffening", "1/$a/$a", "cubic part of the spring; negative = softening")
      .optional("0");
  spec.param(&Params<double>::quadratic, "quadratic", "1/$a", "part by which it is harder one way than the other")
      .optional("0");
  spec.param(&Params<double>::quintic, "quintic", "1/$a/$a/$a/$a", "part of large motion").optional("0");
}

Duffing::OwnStep::OwnStep(const Params<double>& p)
    : step_([&] {
        const auto m = law(p);
        return MassOnStiffeningSpring::Params<double>{
            m.mass, m.damping, m.stiffness, m.stiffening, m.quadratic, m.quintic, 0, 0, 0};
      }()) {}

Kernel duffing_block() { return kernel<Duffing>(); }

}  // namespace hysteron::blocks
