#include "blocks/electrical/pulse_width.h"

namespace hysteron::blocks {

void Pwm::describe(Declaration& d) {
  d.name("pwm", "pulse-width modulation (PWM) with a triangular carrier").in_group("electrical");
  d.law(
       "y = 1 where duty > c(t), else -1 (bipolar); (1 where duty > c) - (1 where -duty > c) (unipolar); 1 where 2 duty - 1 > "
       "c, else 0 (single); c: triangle between -1 and 1, -1 at t = 0")
      .from("Holmes, Lipo, Pulse Width Modulation for Power Converters (2003), section 3.1 (natural sampling)");
  d.remark(
      "The duty ranges from -1 to 1 (single: 0 to 1) and is the mean value of the pulses. Every edge is "
      "located, so steps are no longer than half a carrier period: for long runs with slow loads leave the "
      "modulator out and use the duty itself (averaged model).");
  d.remark(
      "A digital controller updates its duty once per carrier period: put a \"sample_hold\" with that "
      "period before this block.");
  d.remark("For the output voltage of a bridge put an \"h_bridge\" after it.");
  d.input("duty", "", "desired mean value of the pulses");
  d.output("gate", "", "switching state: -1, 0 or 1");
  d.parameter("frequency", "Hz", "frequency of the carrier").positive();
  d.text("modulation", {"bipolar", "unipolar", "single"},
         "bipolar: both legs of a bridge together; unipolar: each leg by itself; single: one switch");
}

Sizes Pwm::sizes(const Shape&) {
  Sizes s;
  s.feedthrough = false;  // a change of the duty acts by a change of mode
  return s;
}

void HBridge::describe(BlockSpec<HBridge>& spec) {
  spec.name("h_bridge", "output voltage of an H-bridge").in_group("electrical").linear();
  spec.law("voltage = supply gate - resistance current")
      .from("Holmes, Lipo, Pulse Width Modulation for Power Converters (2003), section 1.2");
  spec.remark(
      "gate is the output of a \"pwm\", or the duty itself: then the voltage is the average over a carrier "
      "period.");
  spec.input(&In<double>::gate, "gate", "", "switching state or duty, -1 to 1");
  spec.input(&In<double>::current, "current", "A", "load current");
  spec.output(&Out<double>::voltage, "voltage", "V", "voltage between the legs of the bridge");
  spec.param(&Params<double>::supply, "supply", "V", "voltage of the supply").linear();
  spec.param(&Params<double>::resistance, "resistance", "ohm",
             "sum of the on-resistances of the two conducting switches")
      .optional("0")
      .linear()
      .not_negative();
}

void HBridgeWithDeadTime::describe(BlockSpec<HBridgeWithDeadTime>& spec) {
  spec.name("h_bridge_with_dead_time", "output voltage of an H-bridge with dead time of its switches")
      .in_group("electrical");
  spec.law("voltage = supply gate - resistance current - loss sign(current)")
      .from("Holmes, Lipo, Pulse Width Modulation for Power Converters (2003), section 1.5 (mean over a period)");
  spec.remark(
      "loss = 2 supply (dead time) (carrier frequency) for bipolar modulation. With loss 0 the block "
      "equals \"h_bridge\".");
  spec.input(&In<double>::gate, "gate", "", "switching state or duty, -1 to 1");
  spec.input(&In<double>::current, "current", "A", "load current");
  spec.output(&Out<double>::voltage, "voltage", "V", "voltage between the legs of the bridge");
  spec.param(&Params<double>::supply, "supply", "V", "voltage of the supply").linear();
  spec.param(&Params<double>::resistance, "resistance", "ohm",
             "sum of the on-resistances of the two conducting switches")
      .optional("0")
      .linear()
      .not_negative();
  spec.param(&Params<double>::loss, "loss", "V", "mean voltage lost by the dead time").linear().not_negative();
}

Kernel pwm_block() { return kernel<Pwm>(); }
Kernel h_bridge_block() { return kernel<HBridge>(); }
Kernel h_bridge_with_dead_time_block() { return kernel<HBridgeWithDeadTime>(); }

}  // namespace hysteron::blocks
