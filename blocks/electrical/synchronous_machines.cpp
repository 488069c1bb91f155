#include "blocks/electrical/synchronous_machines.h"

namespace hysteron::blocks {

void SynchronousMotor::describe(BlockSpec<SynchronousMotor>& spec) {
  spec.name("synchronous_motor", "synchronous motor with permanent magnets (PMSM) in the frame of its rotor")
      .in_group("electrical");
  spec.law(
          "L_d di_d/dt = v_d - R i_d + p w L_q i_q, L_q di_q/dt = v_q - R i_q - p w (L_d i_d + flux), torque = 3/2 p (flux "
          "i_q + (L_d - L_q) i_d i_q), w = speed")
      .from("Krishnan, Permanent Magnet Synchronous and Brushless DC Motor Drives (2010), chapter 3");
  spec.remark(
      "d and q are amplitudes of the phase quantities (Clarke's factor 2/3); speed is mechanical, p = pole_pairs. The torque "
      "turns an inertia, whose speed comes back: \"in\": [\"v_d\", \"v_q\", \"rotor.speed\"].");
  spec.remark("flux is the voltage constant of a phase (amplitude, V s/rad of the electrical angle).");
  spec.input(&In<double>::voltage_d, "voltage_d", "V", "voltage along the magnets");
  spec.input(&In<double>::voltage_q, "voltage_q", "V", "voltage across them");
  spec.input(&In<double>::speed, "speed", "rad/s", "mechanical speed");
  spec.state(&State<double>::current_d, "current_d", "A", "current along the magnets");
  spec.state(&State<double>::current_q, "current_q", "A", "current across them");
  spec.output(&Out<double>::torque, "torque", "N*m", "torque on the rotor");
  spec.output(&Out<double>::current_d, "current_d", "A", "current along the magnets");
  spec.output(&Out<double>::current_q, "current_q", "A", "current across them");
  spec.param(&Params<double>::resistance, "resistance", "ohm", "of a phase").positive();
  spec.param(&Params<double>::inductance_d, "inductance_d", "H", "along the magnets").positive();
  spec.param(&Params<double>::inductance_q, "inductance_q", "H", "across them").positive();
  spec.param(&Params<double>::flux, "flux", "V*s", "of the magnets, linked with a phase");
  spec.param(&Params<double>::pole_pairs, "pole_pairs", "", "pairs of poles").positive();
}

SynchronousMotor::State<double> SynchronousMotor::rest(const Params<double>& p, const In<double>& in) {
  // R i_d - p w L_q i_q = v_d, p w L_d i_d + R i_q = v_q - p w flux
  const double w = p.pole_pairs * in.speed, a = p.resistance, b = -w * p.inductance_q, c = w * p.inductance_d;
  const double under = a * a - b * c, q = in.voltage_q - w * p.flux;
  return {(a * in.voltage_d - b * q) / under, (a * q - c * in.voltage_d) / under};
}

void StepperMotor::describe(BlockSpec<StepperMotor>& spec) {
  spec.name("stepper_motor", "hybrid stepper motor of two phases").in_group("electrical");
  spec.law(
          "inductance di_a/dt = v_a - resistance i_a + K w sin(N theta), inductance di_b/dt = v_b - resistance i_b - K w "
          "cos(N theta), torque = K (i_b cos(N theta) - i_a sin(N theta)) - detent sin(4 N theta); K = torque_constant, N = "
          "teeth, theta = angle, w = speed")
      .from("Kenjo, Sugawara, Stepping Motors and Their Microprocessor Controls, 2nd ed. (1994), chapter 4");
  spec.remark(
      "A full step is a quarter of a tooth: 50 teeth make 200 steps of 1.8 deg. A current in phase a alone holds it at 0.");
  spec.remark("Angle and speed come back from the inertia that the torque turns.");
  spec.input(&In<double>::voltage_a, "voltage_a", "V", "voltage of phase a");
  spec.input(&In<double>::voltage_b, "voltage_b", "V", "voltage of phase b");
  spec.input(&In<double>::angle, "angle", "rad", "of the rotor");
  spec.input(&In<double>::speed, "speed", "rad/s", "of the rotor");
  spec.state(&State<double>::current_a, "current_a", "A", "current of phase a");
  spec.state(&State<double>::current_b, "current_b", "A", "current of phase b");
  spec.output(&Out<double>::torque, "torque", "N*m", "torque on the rotor");
  spec.output(&Out<double>::current_a, "current_a", "A", "current of phase a");
  spec.output(&Out<double>::current_b, "current_b", "A", "current of phase b");
  spec.param(&Params<double>::resistance, "resistance", "ohm", "of a phase").positive();
  spec.param(&Params<double>::inductance, "inductance", "H", "of a phase").positive();
  spec.param(&Params<double>::torque_constant, "torque_constant", "N*m/A", "of a phase");
  spec.param(&Params<double>::teeth, "teeth", "", "of the rotor").optional("50").positive();
  spec.param(&Params<double>::detent, "detent", "N*m", "amplitude of the torque without current")
      .optional("0")
      .linear();
}

StepperMotor::State<double> StepperMotor::rest(const Params<double>& p, const In<double>& in) {
  const double at = p.teeth * in.angle, emf = p.torque_constant * in.speed;
  return {(in.voltage_a + emf * std::sin(at)) / p.resistance, (in.voltage_b - emf * std::cos(at)) / p.resistance};
}

Kernel synchronous_motor_block() { return kernel<SynchronousMotor>(); }
Kernel stepper_motor_block() { return kernel<StepperMotor>(); }

}  // namespace hysteron::blocks
