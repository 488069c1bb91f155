#include "blocks/mechanics/dc_motor.h"

namespace hysteron::blocks {

namespace {

constexpr const char* source_of_motors =
    "Franklin, Powell, Emami-Naeini, Feedback Control of Dynamic Systems, 7th ed. (2015), section 2.3.1";

template <class B>
void describe_winding(BlockSpec<B>& spec) {
  using P = typename B::template Params<double>;
  spec.param(&P::resistance, "resistance", "Ohm", "of the winding").positive();
  spec.param(&P::inductance, "inductance", "H", "of the winding").positive();
  spec.param(&P::torque_constant, "torque_constant", "N*m/A", "torque per current").positive();
  spec.param(&P::back_emf, "back_emf", "V*s/rad", "voltage per speed; 0 = the same number in SI as torque_constant")
      .optional("0")
      .not_negative();
}

}  // namespace

void DcMotor::describe(BlockSpec<DcMotor>& spec) {
  spec.name("dc_motor", "motor with brushes: winding and rotor").in_group("mechanics").linear();
  spec.law(
          "inductance di/dt = voltage - resistance i - back_emf w, inertia dw/dt = torque_constant i - damping w - load, "
          "d angle/dt = w")
      .from(source_of_motors);
  spec.remark("Of a rotor that is geared, or cogs, take \"dc_winding\" and \"inertia\".");
  spec.variation("presliding", "dc_motor_with_presliding",
                 {{"contact_stiffness", "0 N m/rad"}, {"slip_distance", "1 rad"}});
  spec.input(&In<double>::voltage, "voltage", "V", "at its clamps");
  spec.input(&In<double>::load, "load", "N*m", "torque that holds it back");
  spec.state(&State<double>::angle, "angle", "rad", "of the rotor");
  spec.state(&State<double>::velocity, "velocity", "rad/s", "of the rotor");
  spec.state(&State<double>::current, "current", "A", "in the winding");
  spec.output(&Out<double>::angle, "angle", "rad", "of the rotor");
  spec.output(&Out<double>::velocity, "velocity", "rad/s", "of the rotor");
  spec.output(&Out<double>::current, "current", "A", "in the winding");
  describe_winding(spec);
  spec.param(&Params<double>::inertia, "inertia", "kg*m^2", "of the rotor and what turns with it").positive();
  spec.param(&Params<double>::damping, "damping", "N*m*s/rad", "viscous damping").optional("0").not_negative();
  spec.param(&Params<double>::initial_angle, "initial_angle", "rad", "angle at the start").optional("0");
  spec.param(&Params<double>::initial_velocity, "initial_velocity", "rad/s", "velocity at the start").optional("0");
}

void DcWinding::describe(BlockSpec<DcWinding>& spec) {
  spec.name("dc_winding", "winding of a motor with brushes, whose rotor is a block of its own")
      .in_group("mechanics")
      .linear();
  spec.law("inductance di/dt = voltage - resistance i - back_emf velocity, torque = torque_constant i")
      .from(source_of_motors);
  spec.remark("The torque turns an \"inertia\", whose velocity comes back to the winding.");
  spec.input(&In<double>::voltage, "voltage", "V", "at its clamps");
  spec.input(&In<double>::velocity, "velocity", "rad/s", "of the rotor");
  spec.state(&State<double>::current, "current", "A", "in the winding");
  spec.output(&Out<double>::torque, "torque", "N*m", "on the rotor");
  spec.output(&Out<double>::current, "current", "A", "in the winding");
  describe_winding(spec);
}

Kernel dc_motor_block() { return kernel<DcMotor>(); }
Kernel dc_winding_block() { return kernel<DcWinding>(); }

}  // namespace hysteron::blocks
