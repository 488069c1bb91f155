#include "blocks/mechanics/dc_motor.h"

namespace hysteron::blocks {

namespace {

constexpr const char* source_of_motors =
    "Franklin, Powell, Emami-Naeini, Feedback Control of Dynamic Systems, 7th ed. (2015), section 2.3.1";

template <class B>
void describe_winding(BlockSpec<B>& spec) {
  using P = typename B::template Params<double>;
  spec.param(&P::resistance, "resistance", "Ohm", "resistance of the winding").positive();
  spec.param(&P::inductance, "inductance", "H", "inductance of the winding").positive();
  spec.param(&P::torque_constant, "torque_constant", "N*m/A", "torque constant, torque per current").positive();
  spec.param(&P::back_emf, "back_emf", "V*s/rad",
             "back EMF constant, voltage per speed; 0 = equal to torque_constant (in SI units)")
      .optional("0")
      .not_negative();
}

}  // namespace

void DcMotor::describe(BlockSpec<DcMotor>& spec) {
  spec.name("dc_motor", "brushed DC motor: winding and rotor").in_group("mechanics").linear();
  spec.law(
          "inductance di/dt = voltage - resistance i - back_emf w, inertia dw/dt = torque_constant i - damping w - load, "
          "d angle/dt = w")
      .from(source_of_motors);
  spec.remark(
      "For a rotor with a gear or with cogging combine \"dc_winding\" with blocks of mechanics, e.g. "
      "\"inertia\".");
  spec.variation("presliding", "dc_motor_with_presliding",
                 {{"contact_stiffness", "0 N m/rad"}, {"slip_distance", "1 rad"}});
  spec.input(&In<double>::voltage, "voltage", "V", "voltage at the terminals");
  spec.input(&In<double>::load, "load", "N*m", "load torque; positive values oppose positive rotation");
  spec.state(&State<double>::angle, "angle", "rad", "angle of the rotor");
  spec.state(&State<double>::velocity, "velocity", "rad/s", "angular velocity of the rotor");
  spec.state(&State<double>::current, "current", "A", "current in the winding");
  spec.output(&Out<double>::angle, "angle", "rad", "angle of the rotor");
  spec.output(&Out<double>::velocity, "velocity", "rad/s", "angular velocity of the rotor");
  spec.output(&Out<double>::current, "current", "A", "current in the winding");
  describe_winding(spec);
  spec.param(&Params<double>::inertia, "inertia", "kg*m^2", "inertia of the rotor and of all that turns with it")
      .positive();
  spec.param(&Params<double>::damping, "damping", "N*m*s/rad", "viscous friction").optional("0").not_negative();
  spec.param(&Params<double>::initial_angle, "initial_angle", "rad", "initial angle").optional("0");
  spec.param(&Params<double>::initial_velocity, "initial_velocity", "rad/s", "initial angular velocity").optional("0");
}

void DcWinding::describe(BlockSpec<DcWinding>& spec) {
  spec.name("dc_winding", "winding of a brushed DC motor; the rotor is a block of its own")
      .in_group("mechanics")
      .linear();
  spec.law("inductance di/dt = voltage - resistance i - back_emf velocity, torque = torque_constant i")
      .from(source_of_motors);
  spec.remark("The torque drives an \"inertia\", whose velocity is fed back to the winding.");
  spec.input(&In<double>::voltage, "voltage", "V", "voltage at the terminals");
  spec.input(&In<double>::velocity, "velocity", "rad/s", "angular velocity of the rotor");
  spec.state(&State<double>::current, "current", "A", "current in the winding");
  spec.output(&Out<double>::torque, "torque", "N*m", "torque on the rotor");
  spec.output(&Out<double>::current, "current", "A", "current in the winding");
  describe_winding(spec);
}

Kernel dc_motor_block() { return kernel<DcMotor>(); }
Kernel dc_winding_block() { return kernel<DcWinding>(); }

}  // namespace hysteron::blocks
