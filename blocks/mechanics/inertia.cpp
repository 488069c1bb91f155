#include "blocks/mechanics/inertia.h"

namespace hysteron::blocks {

void Inertia::describe(BlockSpec<Inertia>& spec) {
  spec.name("inertia", "inertia with damper and torsion spring, driven by a torque").linear();
  spec.law("inertia dw/dt = torque - damping w - stiffness angle, d angle/dt = w").from("Newton's second law");
  spec.remark(
      "A shaft that turns freely has stiffness 0. For transmissions use \"gear\", \"belt\" or "
      "\"ball_screw\".");
  spec.variation("drag", "inertia_with_drag", {{"drag", "0"}})
      .variation("friction", "inertia_with_friction", {{"coulomb", "0 N m"}, {"breakaway", "0 N m"}})
      .variation("presliding", "inertia_with_presliding",
                 {{"contact_stiffness", "0 N m/rad"}, {"slip_distance", "1 rad"}})
      .variation("cogging", "inertia_with_cogging", {{"cosine", "0 N m"}, {"sine", "0 N m"}, {"periods", "1"}});
  describe_motion(spec, rotation).optional("0");
  describe_start(spec, rotation);
}

void InertiaWithFriction::describe(BlockSpec<InertiaWithFriction>& spec) {
  spec.name("inertia_with_friction", "inertia with dry friction (true sticking), driven by a torque");
  spec.law(
          "sliding: inertia dw/dt = torque - damping w - stiffness angle - sign(w) (coulomb + (breakaway - coulomb) "
          "exp(-|w/stribeck_velocity|^stribeck_exponent)); sticking: w = 0 until |torque - stiffness angle| reaches "
          "breakaway")
      .from("Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083-1138");
  spec.remark(
      "Three modes: sticking, turning forwards, turning backwards. With coulomb and breakaway 0 the block "
      "equals inertia.");
  describe_motion(spec, rotation).optional("0");
  describe_dry_friction(spec, rotation);
  describe_start(spec, rotation);
  describe_beyond_linear(spec, rotation);
}

void InertiaWithDrag::describe(BlockSpec<InertiaWithDrag>& spec) {
  spec.name("inertia_with_drag", "inertia with quadratic drag (fan, propeller), driven by a torque");
  spec.law("inertia dw/dt = torque - damping w - drag w |w| - stiffness angle, d angle/dt = w")
      .from("Batchelor, An Introduction to Fluid Dynamics (1967), section 5.11");
  describe_motion(spec, rotation).optional("0");
  describe_drag(spec, rotation);
  spec.variation("presliding", "inertia_with_presliding",
                 {{"contact_stiffness", "0 N m/rad"}, {"slip_distance", "1 rad"}});
  describe_start(spec, rotation);
}

void InertiaWithPresliding::describe(Declaration& d) {
  d.name("inertia_with_presliding", "inertia with presliding bearing friction, driven by a torque");
  d.law(
       "inertia dw/dt = torque - damping w - stiffness angle - sum contact_stiffness_i (z_i + contact_time dz_i/dt), d "
       "angle/dt = w, dz_i/dt = w - |w| z_i/(slip_distance_i (1 + excess exp(-(w/stribeck_velocity)^2)))")
      .from("Dahl, AIAA J. 14 (1976) 1675-1682, and as mass_with_presliding");
  d.remark("The friction torque of an element is contact_stiffness times slip_distance.");
  d.remark(
      "Unlike inertia_with_friction it yields elastically before it turns, and under a vibrating torque it "
      "drifts instead of sticking.");
  describe_elements(d, rotation);
  describe_contact_time(d);
}

void InertiaWithCogging::describe(BlockSpec<InertiaWithCogging>& spec) {
  spec.name("inertia_with_cogging", "inertia with cogging torque, driven by a torque");
  spec.law(
          "inertia dw/dt = torque + cosine cos(periods angle) + sine sin(periods angle) - damping w - stiffness angle, "
          "d angle/dt = w")
      .from("Hanselman, Brushless Permanent Magnet Motor Design, 2nd ed. (2003), chapter 8");
  spec.remark(
      "periods: the least common multiple of the numbers of slots and poles; for other torque ripple the "
      "measured number per turn.");
  describe_motion(spec, rotation).optional("0");
  spec.param(&Params<double>::cosine, "cosine", "N*m", "cosine amplitude of the cogging torque (its value at angle 0)");
  spec.param(&Params<double>::sine, "sine", "N*m", "sine amplitude of the cogging torque");
  spec.param(&Params<double>::again, "periods", "", "periods of the cogging torque per turn").positive();
  describe_start(spec, rotation);
}

void MassWithCogging::describe(BlockSpec<MassWithCogging>& spec) {
  spec.name("mass_with_cogging", "mass with cogging force, driven by a force");
  spec.law(
          "mass dv/dt = force + cosine cos(2 pi x/period) + sine sin(2 pi x/period) - damping v - stiffness x, dx/dt = "
          "v")
      .from("Gieras, Piech, Tomczuk, Linear Synchronous Motors, 2nd ed. (2011), section 3.3");
  spec.remark("For an iron-core linear motor; period: the pitch of its magnets, or the measured one.");
  describe_motion(spec, translation).optional("0");
  spec.param(&Params<double>::cosine, "cosine", "N", "cosine amplitude of the cogging force (its value at position 0)");
  spec.param(&Params<double>::sine, "sine", "N", "sine amplitude of the cogging force");
  spec.param(&Params<double>::again, "period", "m", "period of the cogging force along the position").positive();
  describe_start(spec, translation);
}

Kernel inertia_block() { return kernel<Inertia>(); }
Kernel inertia_with_friction_block() { return kernel<InertiaWithFriction>(); }
Kernel inertia_with_drag_block() { return kernel<InertiaWithDrag>(); }
Kernel inertia_with_presliding_block() { return kernel<InertiaWithPresliding>(); }
Kernel inertia_with_cogging_block() { return kernel<InertiaWithCogging>(); }
Kernel mass_with_cogging_block() { return kernel<MassWithCogging>(); }

}  // namespace hysteron::blocks
