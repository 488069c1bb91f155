#include "blocks/electrical/voice_coil.h"

namespace hysteron::blocks {

void Winding::describe(BlockSpec<Winding>& spec) {
  spec.name("winding", "resistance and inductance that a voltage drives a current through")
      .in_group("electrical")
      .linear();
  spec.law("inductance di/dt = voltage - emf - resistance i, i(0) = initial").from("Kirchhoff's voltage law");
  spec.remark(
      "Where the force or torque constant hangs on the position: a \"lookup\" of it, its \"product\" with the velocity as "
      "\"emf\", and with the current as force. With one that does not: \"voice_coil\".");
  spec.remark("A load without a back EMF has a \"constant\" of 0 V there.");
  spec.input(&In<double>::voltage, "voltage", "V", "voltage at the terminals");
  spec.input(&In<double>::emf, "emf", "V", "voltage that the motion induces against it");
  spec.state(&State<double>::current, "current", "A", "current");
  spec.output(&Out<double>::current, "current", "A", "current");
  spec.param(&Params<double>::resistance, "resistance", "ohm", "of the winding").positive();
  spec.param(&Params<double>::inductance, "inductance", "H", "of the winding").positive();
  spec.param(&Params<double>::initial, "initial", "A", "current at the start").optional("0");
}

void VoiceCoil::describe(BlockSpec<VoiceCoil>& spec) {
  spec.name("voice_coil", "coil in the field of a magnet: force from a voltage").in_group("electrical").linear();
  spec.law("inductance di/dt = voltage - resistance i - force_constant velocity, force = force_constant i")
      .from(
          "Lorentz force and induction law; Preumont, Vibration Control of Active Structures, 3rd ed. (2011), section 3.2");
  spec.remark(
      "The same constant stands in N/A and in V s/m: what the coil takes from the supply beyond its heat is the mechanical "
      "power. Wires: the voltage, then the velocity of what it moves, e.g. \"in\": [\"amplifier\", \"stage.velocity\"].");
  spec.input(&In<double>::voltage, "voltage", "V", "voltage at the coil");
  spec.input(&In<double>::velocity, "velocity", "m/s", "velocity of the coil against the magnet");
  spec.state(&State<double>::current, "current", "A", "current");
  spec.output(&Out<double>::force, "force", "N", "force on the coil");
  spec.output(&Out<double>::current, "current", "A", "current");
  spec.param(&Params<double>::force_constant, "force_constant", "N/A", "force over current");
  spec.param(&Params<double>::resistance, "resistance", "ohm", "of the coil").positive();
  spec.param(&Params<double>::inductance, "inductance", "H", "of the coil").positive();
}

Kernel winding_block() { return kernel<Winding>(); }
Kernel voice_coil_block() { return kernel<VoiceCoil>(); }

}  // namespace hysteron::blocks
