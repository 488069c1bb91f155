#include "blocks/linear/lag.h"

namespace hysteron::blocks {

void Lag::describe(Declaration& d) {
  d.name("lag", "first-order lags in series, gain 1").in_group("linear").elementwise().linear().at("command");
  d.law("times[1] dx_1/dt = u - x_1, times[2] dx_2/dt = x_1 - x_2 ..., y = last x").from("definition");
  d.remark("A first-order bandwidth f (-3 dB) corresponds to the time constant 1/(2 pi f).");
  d.input("u", "$a", "the signal");
  d.output("y", "$a", "the low-pass filtered signal");
  d.state("x", "$a", "output of each pole");
  d.list("times", "s", "time constants, one per pole").positive();
}

Sizes Lag::sizes(const Shape& shape) {
  Sizes s;
  s.states = shape.length("times");
  s.feedthrough = false;
  if (s.states < 1) s.error = "\"times\" is empty; give one time constant per pole";
  return s;
}

Kernel lag_block() { return kernel<Lag>(); }

}  // namespace hysteron::blocks
