#include "blocks/mechanics/mass_on_bouc_wen_spring.h"

#include <cmath>

namespace hysteron::blocks {

void MassOnBoucWenSpring::describe(Declaration& d) {
  d.name("mass_on_bouc_wen_spring", "mass on a spring with Bouc-Wen hysteresis, driven by a force");
  d.law(
       "mass dv/dt = force - damping v - (1 - hysteretic_share) stiffness x - z, dx/dt = v, dz/dt = hysteretic_share "
       "stiffness v - (beta |v| z + gamma v |z|)")
      .from(
          "Wen, J. Eng. Mech. Div. ASCE 102 (1976) 249-263; Noel, Schoukens, Hysteretic benchmark with a dynamic "
          "nonlinearity, Workshop on Nonlinear System Identification Benchmarks (2016)");
  d.remark(
      "beta sets the width of the loop; the spring softens with the travel for beta + gamma above 0 and "
      "hardens below 0.");
  d.remark(
      "With hysteretic_share 0 the block equals mass_spring_damper. For a spring of elastic-plastic "
      "elements use mass_on_hysteretic_spring.");
  describe_motion(d);
  d.state("held_back", "N", "hysteretic force z");
  d.parameter("hysteretic_share", "", "hysteretic fraction of the stiffness, 0 .. 1")
      .optional("0")
      .not_negative()
      .maximum = 1;
  d.parameter("beta", "1/m", "loop shape: dissipative term beta |v| z").optional("0 1/m").not_negative();
  d.parameter("gamma", "1/m", "loop shape: conservative term gamma v |z|").optional("0 1/m");
  describe_start(d);
  describe_beyond_linear(d);
}

Sizes MassOnBoucWenSpring::sizes(const Shape&) {
  Sizes s;
  s.states = 3;
  s.outputs = 2;
  s.feedthrough = false;
  return s;
}

mass_motion::Force HeldByBoucWen::force(double way) const {
  const double z = bouc_wen::z_in_closed_form(law_, z_, way), side = way < 0 ? -1 : 1;
  return {-z, -side * bouc_wen::z_rate(law_, z, side)};
}

MassOnBoucWenSpring::OwnStep::OwnStep(const View<double>& v)
    : StepUnderMemory<HeldByBoucWen>(elastic(v), HeldByBoucWen(remembering(v))) {}

/// The law holds nothing back: as after a long decaying motion.
void MassOnBoucWenSpring::rest(const View<double>& v) {
  v.out[0] = mass_spring_damper::rest(elastic(v), v.u[0]);
  v.out[1] = v.out[2] = 0;
}

void MassOnBoucWenSpring::initial_states(const View<double>& v) {
  v.out[0] = v.parameter(initial_position);
  v.out[1] = v.parameter(initial_velocity);
  v.out[2] = 0;
}

Kernel mass_on_bouc_wen_spring_block() { return kernel<MassOnBoucWenSpring>(); }

}  // namespace hysteron::blocks
