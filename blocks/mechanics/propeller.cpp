#include "blocks/mechanics/propeller.h"

namespace hysteron::blocks {

void Propeller::describe(BlockSpec<Propeller>& spec) {
  spec.name("propeller", "propeller or fan: thrust and torque by the square of a speed that lags")
      .in_group("mechanics");
  spec.law(
          "time d speed/dt = command - speed, thrust = thrust_coefficient w |w|, torque = torque_coefficient w |w|, w = speed")
      .from("Beard, McLain, Small Unmanned Aircraft (2012), section 4.3, at rest in the air");
  spec.remark(
      "The torque is that of the air against the rotor; the body that carries the motor feels it the other way round.");
  spec.remark("torque_coefficient 0 (nothing said): the torque is not asked for.");
  spec.input(&In<double>::command, "command", "rad/s", "speed that is asked for, e.g. by the motor's controller");
  spec.state(&State<double>::speed, "speed", "rad/s", "speed of the rotor");
  spec.output(&Out<double>::thrust, "thrust", "N", "thrust");
  spec.output(&Out<double>::torque, "torque", "N*m", "torque of the air");
  spec.output(&Out<double>::speed, "speed", "rad/s", "speed of the rotor");
  spec.param(&Params<double>::thrust_coefficient, "thrust_coefficient", "N*s^2/rad^2",
             "thrust over the square of the speed")
      .linear();
  spec.param(&Params<double>::torque_coefficient, "torque_coefficient", "N*m*s^2/rad^2",
             "torque over the square of the speed")
      .optional("0")
      .linear();
  spec.param(&Params<double>::time, "time", "s", "in which the speed follows").positive();
  spec.param(&Params<double>::initial, "initial", "rad/s", "speed at the start").optional("0");
}

Kernel propeller_block() { return kernel<Propeller>(); }

}  // namespace hysteron::blocks
