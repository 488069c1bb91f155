#include "blocks/electrical/synchronous_machines.h"

namespace hysteron::blocks {

void SynchronousMotor::describe(BlockSpec<SynchronousMotor>& spec) {
  spec.name("synchronous_motor", "permanent-magnet synchronous motor (PMSM) in dq coordinates").in_group("electrical");
  spec.law(
          "L_d di_d/dt = v_d - R i_d + p w L_q i_q, L_q di_q/dt = v_q - R i_q - p w (L_d i_d + flux), torque = 3/2 p (flux "
          "i_q + (L_d - L_q) i_d i_q), w = speed")
      .from("Krishnan, Permanent Magnet Synchronous and Brushless DC Motor Drives (2010), chapter 3");
  spec.remark(
      "d and q quantities have the amplitude of the phase quantities (Clarke factor 2/3); speed is "
      "mechanical, p = pole_pairs. The torque drives an \"inertia\", whose speed is fed back: \"in\": "
      "[\"v_d\", \"v_q\", \"rotor.velocity\"].");
  spec.remark(
      "flux equals the phase voltage constant: amplitude of the back EMF over the electrical speed, V "
      "s/rad.");
  spec.input(&In<double>::voltage_d, "voltage_d", "V", "d-axis voltage (along the magnets)");
  spec.input(&In<double>::voltage_q, "voltage_q", "V", "q-axis voltage (across the magnets)");
  spec.input(&In<double>::speed, "speed", "rad/s", "mechanical speed of the rotor");
  spec.state(&State<double>::current_d, "current_d", "A", "d-axis current");
  spec.state(&State<double>::current_q, "current_q", "A", "q-axis current");
  spec.output(&Out<double>::torque, "torque", "N*m", "torque on the rotor");
  spec.output(&Out<double>::current_d, "current_d", "A", "d-axis current");
  spec.output(&Out<double>::current_q, "current_q", "A", "q-axis current");
  spec.param(&Params<double>::resistance, "resistance", "ohm", "resistance of a phase").positive();
  spec.param(&Params<double>::inductance_d, "inductance_d", "H", "d-axis inductance").positive();
  spec.param(&Params<double>::inductance_q, "inductance_q", "H", "q-axis inductance").positive();
  spec.param(&Params<double>::flux, "flux", "V*s", "flux linkage of the magnets with a phase, amplitude");
  spec.param(&Params<double>::pole_pairs, "pole_pairs", "", "number of pole pairs").positive();
}

SynchronousMotor::State<double> SynchronousMotor::rest(const Params<double>& p, const In<double>& in) {
  // R i_d - p w L_q i_q = v_d, p w L_d i_d + R i_q = v_q - p w flux
  const double w = p.pole_pairs * in.speed, a = p.resistance, b = -w * p.inductance_q, c = w * p.inductance_d;
  const double under = a * a - b * c, q = in.voltage_q - w * p.flux;
  return {(a * in.voltage_d - b * q) / under, (a * q - c * in.voltage_d) / under};
}

void StepperMotor::describe(BlockSpec<StepperMotor>& spec) {
  spec.name("stepper_motor", "two-phase hybrid stepper motor").in_group("electrical");
  spec.law(
          "inductance di_a/dt = v_a - resistance i_a + K w sin(N theta), inductance di_b/dt = v_b - resistance i_b - K w "
          "cos(N theta), torque = K (i_b cos(N theta) - i_a sin(N theta)) - detent sin(4 N theta); K = torque_constant, N = "
          "teeth, theta = angle, w = speed")
      .from("Kenjo, Sugawara, Stepping Motors and Their Microprocessor Controls, 2nd ed. (1994), chapter 4");
  spec.remark(
      "A full step is a quarter of a tooth pitch: 50 teeth give 200 steps of 1.8 deg. A positive current "
      "in phase a alone holds the rotor at angle 0.");
  spec.remark("The torque drives an \"inertia\", whose angle and speed are fed back.");
  spec.input(&In<double>::voltage_a, "voltage_a", "V", "voltage of phase a");
  spec.input(&In<double>::voltage_b, "voltage_b", "V", "voltage of phase b");
  spec.input(&In<double>::angle, "angle", "rad", "angle of the rotor");
  spec.input(&In<double>::speed, "speed", "rad/s", "speed of the rotor");
  spec.state(&State<double>::current_a, "current_a", "A", "current of phase a");
  spec.state(&State<double>::current_b, "current_b", "A", "current of phase b");
  spec.output(&Out<double>::torque, "torque", "N*m", "torque on the rotor");
  spec.output(&Out<double>::current_a, "current_a", "A", "current of phase a");
  spec.output(&Out<double>::current_b, "current_b", "A", "current of phase b");
  spec.param(&Params<double>::resistance, "resistance", "ohm", "resistance of a phase").positive();
  spec.param(&Params<double>::inductance, "inductance", "H", "inductance of a phase").positive();
  spec.param(&Params<double>::torque_constant, "torque_constant", "N*m/A", "torque constant of a phase");
  spec.param(&Params<double>::teeth, "teeth", "", "number of rotor teeth").optional("50").positive();
  spec.param(&Params<double>::detent, "detent", "N*m", "amplitude of the detent torque (torque without current)")
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
