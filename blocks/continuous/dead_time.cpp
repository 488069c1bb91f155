#include "blocks/continuous/dead_time.h"

namespace hysteron::blocks {

void DeadTime::describe(Declaration& d) {
  d.name("dead_time", "its input, delayed without change of shape").in_group("continuous").elementwise().at("command");
  d.law("y(t) = u(t - delay); before the start the input is taken to have been at rest").from("definition");
  d.remark(
      "A delay shorter than the solver's step is continued from the last accepted point, straight on: first order "
      "accurate.");
  d.input("u", "$a", "the signal");
  d.output("y", "$a", "the signal, later");
  d.parameter("delay", "s", "how much later").not_negative();
}

Sizes DeadTime::sizes(const Shape&) {
  Sizes s;
  s.feedthrough = false;
  s.history = true;
  return s;
}

Kernel dead_time_block() { return kernel<DeadTime>(); }

}  // namespace hysteron::blocks
