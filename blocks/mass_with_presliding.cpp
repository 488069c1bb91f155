#include "blocks/mass_with_presliding.h"

#include "blocks/mass_spring_damper.h"

namespace hysteron::blocks {

void MassWithPresliding::describe(Declaration& d) {
  d.name("mass_with_presliding", "one mass on a spring beside which elements stick and slip, driven by a force");
  d.law(
       "mass dv/dt = force - damping v - stiffness x - sum contact_stiffness_i z_i, dx/dt = v, dz_i/dt = v - |v| "
       "z_i/slip_distance_i")
      .from(
          "Dahl, AIAA J. 14 (1976) 1675-1682; several elements: Lampaert, Al-Bender, Swevers, PhysCon (2003) "
          "1170-1178");
  d.remark("One element is a guide with friction; several, soft and stiff ones, are a spring with hysteresis.");
  d.remark("Unlike mass_with_friction it gives way a little before it slides, and it never sticks for good.");
  describe_motion(d);
  d.state("deflection", "m", "deflection of each element");
  d.list("contact_stiffness", "N/m", "stiffness of each element while it sticks").not_negative();
  d.list("slip_distance", "m", "deflection at which each element slips; its friction is stiffness times distance")
      .positive()
      .difference()
      .as_long_as("contact_stiffness");
  describe_start(d);
}

Sizes MassWithPresliding::sizes(const Shape& shape) {
  Sizes s;
  const int n = shape.length("contact_stiffness");
  s.states = 2 + n;
  s.outputs = 2;
  s.feedthrough = false;
  if (n < 1 || n != shape.length("slip_distance"))
    s.error = "\"contact_stiffness\" and \"slip_distance\" must be lists of one length; give one of each per element";
  return s;
}

Kernel mass_with_presliding_block() { return kernel<MassWithPresliding>(); }

}  // namespace hysteron::blocks
