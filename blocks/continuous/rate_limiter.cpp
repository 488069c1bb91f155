#include "blocks/continuous/rate_limiter.h"

namespace hysteron::blocks {

namespace {

template <class B>
void remarks(BlockSpec<B>& spec) {
  spec.remark(
      "The input may jump. Three modes: tracking, rising, falling; the instants between them are located. Without "
      "feedthrough: it breaks algebraic loops.");
  spec.remark("An infinite limit leaves a lag of the time constant.");
}

}  // namespace

void RateLimiter::describe(BlockSpec<RateLimiter>& spec) {
  spec.name("rate_limiter", "follows its input, but not faster than its limits")
      .in_group("continuous")
      .elementwise()
      .at("command");
  spec.law("dy/dt = max(-fall, min(rise, (u - y)/time))").from("definition");
  remarks(spec);
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.state(&State<double>::y, "y", "$a", "the follower");
  spec.output(&Out<double>::y, "y", "$a", "the follower");
  spec.param(&Params<double>::rise, "rise", "$a/s", "largest rate upwards").positive();
  spec.param(&Params<double>::fall, "fall", "$a/s", "largest rate downwards").positive();
  spec.param(&Params<double>::time, "time", "s", "time constant with which a small gap closes")
      .optional("10 us")
      .positive();
  spec.param(&Params<double>::initial, "initial", "$a", "follower at the start").optional("0");
}

void CurrentLimit::describe(BlockSpec<CurrentLimit>& spec) {
  spec.name("current_limit", "voltage of an amplifier of limited current on a capacitive load")
      .in_group("continuous")
      .elementwise()
      .at("command");
  spec.law("dy/dt = max(-sink/capacitance, min(source/capacitance, (u - y)/time))")
      .from("current of a capacitor, I = C dU/dt");
  remarks(spec);
  spec.remark("A sine of amplitude A and frequency f asks for the current 2 pi f A capacitance.");
  spec.input(&In<double>::u, "u", "V", "voltage that the amplifier should give");
  spec.state(&State<double>::y, "y", "V", "voltage of the load");
  spec.output(&Out<double>::y, "y", "V", "voltage of the load");
  spec.param(&Params<double>::source, "source", "A", "largest charging current").positive();
  spec.param(&Params<double>::sink, "sink", "A", "largest discharging current").positive();
  spec.param(&Params<double>::capacitance, "capacitance", "F", "of the load").positive();
  spec.param(&Params<double>::time, "time", "s", "time constant of the amplifier, 1/(2 pi bandwidth)")
      .optional("10 us")
      .positive();
  spec.param(&Params<double>::initial, "initial", "V", "voltage of the load at the start").optional("0");
}

Kernel rate_limiter_block() { return kernel<RateLimiter>(); }
Kernel current_limit_block() { return kernel<CurrentLimit>(); }

}  // namespace hysteron::blocks
