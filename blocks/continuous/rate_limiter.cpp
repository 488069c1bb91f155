#include "blocks/continuous/rate_limiter.h"

namespace hysteron::blocks {

namespace {

template <class B>
void remarks(BlockSpec<B>& spec) {
  spec.remark(
      "The input may jump. Three modes: tracking, rising, falling; the instants of change are located. "
      "There is no direct feedthrough, so the block breaks algebraic loops.");
  spec.remark("With infinite limits the block is a first-order lag with this time constant.");
}

}  // namespace

void RateLimiter::describe(BlockSpec<RateLimiter>& spec) {
  spec.name("rate_limiter", "limits the rate of change of a signal").in_group("continuous").elementwise().at("command");
  spec.law("dy/dt = max(-fall, min(rise, (u - y)/time))").from("definition");
  remarks(spec);
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.state(&State<double>::y, "y", "$a", "the rate-limited signal");
  spec.output(&Out<double>::y, "y", "$a", "the rate-limited signal");
  spec.param(&Params<double>::rise, "rise", "$a/s", "largest rising rate").positive();
  spec.param(&Params<double>::fall, "fall", "$a/s", "largest falling rate, as a positive number").positive();
  spec.param(&Params<double>::time, "time", "s", "time constant of tracking while no limit is active")
      .optional("10 us")
      .positive();
  spec.param(&Params<double>::initial, "initial", "$a", "initial value of the output").optional("0");
}

void CurrentLimit::describe(BlockSpec<CurrentLimit>& spec) {
  spec.name("current_limit", "amplifier with limited current on a capacitive load")
      .in_group("continuous")
      .elementwise()
      .at("command");
  spec.law("dy/dt = max(-sink/capacitance, min(source/capacitance, (u - y)/time))")
      .from("current of a capacitor, I = C dU/dt");
  remarks(spec);
  spec.remark("A sine of amplitude A and frequency f needs the peak current 2 pi f A capacitance.");
  spec.input(&In<double>::u, "u", "V", "commanded voltage");
  spec.state(&State<double>::y, "y", "V", "voltage across the load");
  spec.output(&Out<double>::y, "y", "V", "voltage across the load");
  spec.param(&Params<double>::source, "source", "A", "largest charging current").positive();
  spec.param(&Params<double>::sink, "sink", "A", "largest discharging current, as a positive number").positive();
  spec.param(&Params<double>::capacitance, "capacitance", "F", "capacitance of the load").positive();
  spec.param(&Params<double>::time, "time", "s", "time constant of the amplifier, 1/(2 pi bandwidth)")
      .optional("10 us")
      .positive();
  spec.param(&Params<double>::initial, "initial", "V", "initial voltage across the load").optional("0");
}

Kernel rate_limiter_block() { return kernel<RateLimiter>(); }
Kernel current_limit_block() { return kernel<CurrentLimit>(); }

}  // namespace hysteron::blocks
