#include "blocks/mechanics/pendulum.h"

namespace hysteron::blocks {

void Pendulum::describe(BlockSpec<Pendulum>& spec) {
  spec.name("pendulum", "pendulum: mass on an arm under gravity, driven by a torque").in_group("mechanics");
  spec.law(
          "(inertia + mass length^2) d speed/dt = torque - damping speed - mass gravity length sin(angle), d angle/dt = speed")
      .from("Goldstein, Poole, Safko, Classical Mechanics, 3rd ed. (2002), chapter 5");
  spec.remark(
      "The angle is 0 where it hangs down; upright is \"180 deg\". It also describes one link of a robot "
      "arm in a vertical plane.");
  spec.remark(
      "inertia is about the centre of mass: 0 for a point mass, mass (2 length)^2/12 for a uniform rod "
      "(length: pivot to its centre).");
  spec.variation("presliding", "pendulum_with_presliding",
                 {{"contact_stiffness", "0 N m/rad"}, {"slip_distance", "1 rad"}});
  spec.input(&In<double>::torque, "torque", "N*m", "torque at the pivot");
  spec.state(&State<double>::angle, "angle", "rad", "angle from the hanging position");
  spec.state(&State<double>::speed, "speed", "rad/s", "angular velocity");
  spec.output(&Out<double>::angle, "angle", "rad", "angle from the hanging position");
  spec.output(&Out<double>::speed, "speed", "rad/s", "angular velocity");
  spec.param(&Params<double>::mass, "mass", "kg", "mass").positive();
  spec.param(&Params<double>::length, "length", "m", "distance from the pivot to the centre of mass").positive();
  spec.param(&Params<double>::inertia, "inertia", "kg*m^2", "moment of inertia about the centre of mass")
      .optional("0")
      .not_negative();
  spec.param(&Params<double>::damping, "damping", "N*m*s/rad", "viscous friction at the pivot")
      .optional("0")
      .not_negative();
  spec.param(&Params<double>::gravity, "gravity", "m/s^2", "component of gravity in the plane of motion")
      .optional("9.80665 m/s^2");
  spec.param(&Params<double>::initial_angle, "initial_angle", "rad", "initial angle").optional("0");
  spec.param(&Params<double>::initial_speed, "initial_speed", "rad/s", "initial angular velocity").optional("0");
}

Kernel pendulum_block() { return kernel<Pendulum>(); }

}  // namespace hysteron::blocks
