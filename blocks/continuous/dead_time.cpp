#include "blocks/continuous/dead_time.h"

namespace hysteron::blocks {

void DeadTime::describe(Declaration& d) {
  d.name("dead_time", "dead time: delays its input by a constant time")
      .in_group("continuous")
      .elementwise()
      .at("command");
  d.law("y(t) = u(t - delay); before the start the input is taken as constant").from("definition");
  d.remark(
      "Where the delay is shorter than the solver's step, the input is extrapolated linearly from the last "
      "accepted step (first-order accurate).");
  d.input("u", "$a", "the signal");
  d.output("y", "$a", "the delayed signal");
  d.parameter("delay", "s", "dead time").not_negative();
}

Sizes DeadTime::sizes(const Shape&) {
  Sizes s;
  s.feedthrough = false;
  s.history = true;
  return s;
}

Kernel dead_time_block() { return kernel<DeadTime>(); }

}  // namespace hysteron::blocks
