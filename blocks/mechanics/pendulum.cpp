#include "blocks/mechanics/pendulum.h"

namespace hysteron::blocks {

void Pendulum::describe(BlockSpec<Pendulum>& spec) {
  spec.name("pendulum", "mass on an arm under gravity, driven by a torque").in_group("mechanics");
  spec.law(
          "(inertia + mass length^2) d speed/dt = torque - damping speed - mass gravity length sin(angle), d angle/dt = speed")
      .from("Goldstein, Poole, Safko, Classical Mechanics, 3rd ed. (2002), chapter 5");
  spec.remark(
      "The angle counts from where it hangs; upright is \"180 deg\". An arm of a robot in a vertical plane is one.");
  spec.remark(
      "inertia is that about the centre of mass: 0 for a point, mass (2 length)^2/12 for a rod of twice the length.");
  spec.variation("presliding", "pendulum_with_presliding",
                 {{"contact_stiffness", "0 N m/rad"}, {"slip_distance", "1 rad"}});
  spec.input(&In<double>::torque, "torque", "N*m", "torque at the pivot");
  spec.state(&State<double>::angle, "angle", "rad", "angle from where it hangs");
  spec.state(&State<double>::speed, "speed", "rad/s", "its rate");
  spec.output(&Out<double>::angle, "angle", "rad", "angle from where it hangs");
  spec.output(&Out<double>::speed, "speed", "rad/s", "its rate");
  spec.param(&Params<double>::mass, "mass", "kg", "mass").positive();
  spec.param(&Params<double>::length, "length", "m", "from the pivot to the centre of mass").positive();
  spec.param(&Params<double>::inertia, "inertia", "kg*m^2", "about the centre of mass").optional("0").not_negative();
  spec.param(&Params<double>::damping, "damping", "N*m*s/rad", "viscous friction of the pivot")
      .optional("0")
      .not_negative();
  spec.param(&Params<double>::gravity, "gravity", "m/s^2", "along the plane in which it swings")
      .optional("9.80665 m/s^2");
  spec.param(&Params<double>::initial_angle, "initial_angle", "rad", "angle at the start").optional("0");
  spec.param(&Params<double>::initial_speed, "initial_speed", "rad/s", "its rate at the start").optional("0");
}

Kernel pendulum_block() { return kernel<Pendulum>(); }

}  // namespace hysteron::blocks
