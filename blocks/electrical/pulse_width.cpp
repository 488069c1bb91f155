#include "blocks/electrical/pulse_width.h"

namespace hysteron::blocks {

void Pwm::describe(Declaration& d) {
  d.name("pwm", "pulse width modulation by a triangular carrier").in_group("electrical");
  d.law(
       "y = 1 where duty > c(t), else -1 (bipolar); (1 where duty > c) - (1 where -duty > c) (unipolar); 1 where 2 duty - 1 > "
       "c, else 0 (single); c: triangle between -1 and 1, -1 at t = 0")
      .from("Holmes, Lipo, Pulse Width Modulation for Power Converters (2003), section 3.1 (natural sampling)");
  d.remark(
      "The duty goes from -1 to 1 (single: 0 to 1), and is the mean of the pulses. Edges are found exactly, so steps are no "
      "longer than half a period of the carrier: for long runs of slow loads leave the modulator out and take the mean.");
  d.remark("A controller writes its duty once per period: put a \"sample_hold\" of that period before it.");
  d.remark("At a bridge: \"h_bridge\".");
  d.input("duty", "", "what the pulses shall be on the mean");
  d.output("gate", "", "what is switched: -1, 0 or 1");
  d.parameter("frequency", "Hz", "of the carrier").positive();
  d.text("modulation", {"bipolar", "unipolar", "single"},
         "both legs of a bridge together, each by itself, or one switch");
}

Sizes Pwm::sizes(const Shape&) {
  Sizes s;
  s.feedthrough = false;  // a change of the duty acts by a change of mode
  return s;
}

void HBridge::describe(BlockSpec<HBridge>& spec) {
  spec.name("h_bridge", "voltage of a bridge from what its switches do").in_group("electrical").linear();
  spec.law("voltage = supply gate - resistance current")
      .from("Holmes, Lipo, Pulse Width Modulation for Power Converters (2003), section 1.2");
  spec.remark("The gate is that of a \"pwm\", or the duty itself: then the voltage is the mean over the pulses.");
  spec.input(&In<double>::gate, "gate", "", "what is switched, -1 to 1");
  spec.input(&In<double>::current, "current", "A", "current that the bridge drives");
  spec.output(&Out<double>::voltage, "voltage", "V", "voltage between its legs");
  spec.param(&Params<double>::supply, "supply", "V", "voltage of the supply").linear();
  spec.param(&Params<double>::resistance, "resistance", "ohm", "of the two switches that conduct")
      .optional("0")
      .linear()
      .not_negative();
}

void HBridgeWithDeadTime::describe(BlockSpec<HBridgeWithDeadTime>& spec) {
  spec.name("h_bridge_with_dead_time", "voltage of a bridge whose switches pause between their changes")
      .in_group("electrical");
  spec.law("voltage = supply gate - resistance current - loss sign(current)")
      .from("Holmes, Lipo, Pulse Width Modulation for Power Converters (2003), section 1.5 (mean over a period)");
  spec.remark("loss = 2 supply pause frequency of the carrier (bipolar). With loss 0 it is \"h_bridge\".");
  spec.input(&In<double>::gate, "gate", "", "what is switched, -1 to 1");
  spec.input(&In<double>::current, "current", "A", "current that the bridge drives");
  spec.output(&Out<double>::voltage, "voltage", "V", "voltage between its legs");
  spec.param(&Params<double>::supply, "supply", "V", "voltage of the supply").linear();
  spec.param(&Params<double>::resistance, "resistance", "ohm", "of the two switches that conduct")
      .optional("0")
      .linear()
      .not_negative();
  spec.param(&Params<double>::loss, "loss", "V", "what the pauses take, on the mean").linear().not_negative();
}

Kernel pwm_block() { return kernel<Pwm>(); }
Kernel h_bridge_block() { return kernel<HBridge>(); }
Kernel h_bridge_with_dead_time_block() { return kernel<HBridgeWithDeadTime>(); }

}  // namespace hysteron::blocks
