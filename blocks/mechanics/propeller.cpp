#include "blocks/mechanics/propeller.h"

namespace hysteron::blocks {

void Propeller::describe(BlockSpec<Propeller>& spec) {
  spec.name("propeller", "propeller or fan: thrust and torque from a lagged speed").in_group("mechanics");
  spec.law(
          "time d speed/dt = command - speed, thrust = thrust_coefficient w |w|, torque = torque_coefficient w |w|, w = speed")
      .from("Beard, McLain, Small Unmanned Aircraft (2012), section 4.3, at rest in the air");
  spec.remark(
      "torque is the drag torque of the air on the rotor; its reaction on the body that carries the motor "
      "has the opposite sign.");
  spec.remark("If torque_coefficient is left out, the torque is 0.");
  spec.input(&In<double>::command, "command", "rad/s", "commanded speed, e.g. from the motor controller");
  spec.state(&State<double>::speed, "speed", "rad/s", "speed of the rotor");
  spec.output(&Out<double>::thrust, "thrust", "N", "thrust");
  spec.output(&Out<double>::torque, "torque", "N*m", "drag torque of the air");
  spec.output(&Out<double>::speed, "speed", "rad/s", "speed of the rotor");
  spec.param(&Params<double>::thrust_coefficient, "thrust_coefficient", "N*s^2/rad^2", "thrust per squared speed")
      .linear();
  spec.param(&Params<double>::torque_coefficient, "torque_coefficient", "N*m*s^2/rad^2",
             "drag torque per squared speed")
      .optional("0")
      .linear();
  spec.param(&Params<double>::time, "time", "s", "time constant with which the speed follows the command").positive();
  spec.param(&Params<double>::initial, "initial", "rad/s", "initial speed").optional("0");
}

Kernel propeller_block() { return kernel<Propeller>(); }

}  // namespace hysteron::blocks
