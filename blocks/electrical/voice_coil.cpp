#include "blocks/electrical/voice_coil.h"

namespace hysteron::blocks {

void Winding::describe(BlockSpec<Winding>& spec) {
  spec.name("winding", "winding: current through a resistance and an inductance").in_group("electrical").linear();
  spec.law("inductance di/dt = voltage - emf - resistance i, i(0) = initial").from("Kirchhoff's voltage law");
  spec.remark(
      "For a force or torque constant that depends on the position: take it from a \"lookup\"; its "
      "\"product\" with the velocity is \"emf\", its \"product\" with the current is the force. For a "
      "constant one use \"voice_coil\".");
  spec.remark("For a load without back EMF wire a \"constant\" of 0 V to \"emf\".");
  spec.input(&In<double>::voltage, "voltage", "V", "voltage at the terminals");
  spec.input(&In<double>::emf, "emf", "V", "back EMF; positive values oppose the voltage");
  spec.state(&State<double>::current, "current", "A", "current");
  spec.output(&Out<double>::current, "current", "A", "current");
  spec.param(&Params<double>::resistance, "resistance", "ohm", "resistance of the winding").positive();
  spec.param(&Params<double>::inductance, "inductance", "H", "inductance of the winding").positive();
  spec.param(&Params<double>::initial, "initial", "A", "initial current").optional("0");
}

void VoiceCoil::describe(BlockSpec<VoiceCoil>& spec) {
  spec.name("voice_coil", "voice coil actuator: force from a voltage").in_group("electrical").linear();
  spec.law("inductance di/dt = voltage - resistance i - force_constant velocity, force = force_constant i")
      .from(
          "Lorentz force and induction law; Preumont, Vibration Control of Active Structures, 3rd ed. (2011), section 3.2");
  spec.remark(
      "The force constant in N/A equals the back EMF constant in V s/m (conservation of energy). Wire the "
      "voltage, then the velocity of the moving part, e.g. \"in\": [\"amplifier\", \"stage.velocity\"].");
  spec.input(&In<double>::voltage, "voltage", "V", "voltage at the coil terminals");
  spec.input(&In<double>::velocity, "velocity", "m/s", "velocity of the coil relative to the magnet");
  spec.state(&State<double>::current, "current", "A", "current");
  spec.output(&Out<double>::force, "force", "N", "force on the coil");
  spec.output(&Out<double>::current, "current", "A", "current");
  spec.param(&Params<double>::force_constant, "force_constant", "N/A", "force per current");
  spec.param(&Params<double>::resistance, "resistance", "ohm", "resistance of the coil").positive();
  spec.param(&Params<double>::inductance, "inductance", "H", "inductance of the coil").positive();
}

Kernel winding_block() { return kernel<Winding>(); }
Kernel voice_coil_block() { return kernel<VoiceCoil>(); }

}  // namespace hysteron::blocks
