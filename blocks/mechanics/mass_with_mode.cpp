#include "blocks/mechanics/mass_with_mode.h"

#include "blocks/mechanics/mass_spring_damper.h"

namespace hysteron::blocks {

void MassWithMode::describe(Declaration& d) {
  d.name("mass_with_mode", "mass on a spring that carries a second mass, driven by a force").linear();
  d.law(
       "mass dv/dt = force - damping v - stiffness x - share mass q'', dx/dt = v, q'' = w^2 (x - q) + 2 mode_damping w "
       "(v - q'), w = 2 pi frequency")
      .from("two masses in a row; Den Hartog, Mechanical Vibrations, 4th ed. (1956), chapter 3 (absorber)");
  d.remark("With share 0 the block equals mass_spring_damper: the second mass does not react on the first.");
  d.remark(
      "frequency is that of the second mass with the first one fixed, not a natural frequency of both "
      "together.");
  describe_motion(d);
  d.state("mode_position", "m", "position of the second mass");
  d.state("mode_rate", "m", "velocity of the second mass over w");
  d.parameter("share", "", "mass ratio: second mass over first mass").not_negative();
  d.parameter("frequency", "Hz", "natural frequency of the second mass with the first one fixed").positive();
  d.parameter("mode_damping", "", "damping ratio of the second mass with the first one fixed")
      .optional("0.01")
      .not_negative();
  describe_start(d);
}

Sizes MassWithMode::sizes(const Shape&) {
  Sizes s;
  s.states = 4;
  s.outputs = 2;
  s.feedthrough = false;
  return s;
}

void MassWithMode::rest(const View<double>& v) {
  v.out[position] =
      mass_spring_damper::rest({v.parameter(mass), v.parameter(damping), v.parameter(stiffness), 0}, v.u[0]);
  v.out[mode_position] = v.out[position];
  v.out[velocity] = v.out[mode_rate] = 0;
}

void MassWithMode::initial_states(const View<double>& v) {
  v.out[position] = v.out[mode_position] = v.parameter(initial_position);
  v.out[velocity] = v.parameter(initial_velocity);
  v.out[mode_rate] = v.parameter(initial_velocity) / (v.parameter(frequency) * 6.283185307179586476925287);
}

Kernel mass_with_mode_block() { return kernel<MassWithMode>(); }

}  // namespace hysteron::blocks
