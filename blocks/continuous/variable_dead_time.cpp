#include "blocks/continuous/variable_dead_time.h"

namespace hysteron::blocks {

void VariableDeadTime::describe(Declaration& d) {
  d.name("variable_dead_time", "its input, delayed by a time that is a signal").in_group("continuous");
  d.law("y(t) = u(t - delay(t)), 0 <= delay <= longest; before the start the input is taken to have been at rest")
      .from("definition");
  d.remark("What flows through a pipe at a speed that changes: delay = length/speed, as of now.");
  d.remark(
      "A delay shorter than the solver's step is continued from the last accepted point, straight on: first order "
      "accurate; \"max_step\" of the solver may be set to the shortest delay.");
  d.input("u", "$a", "the signal");
  d.input("delay", "s", "how much later; outside of 0 .. longest the nearer of the two");
  d.output("y", "$a", "the signal, later");
  d.parameter("longest", "s", "longest delay: so much of the past is kept").positive();
}

Sizes VariableDeadTime::sizes(const Shape&) {
  Sizes s;
  s.history = true;
  s.kinks = 2;
  return s;
}

Kernel variable_dead_time_block() { return kernel<VariableDeadTime>(); }

}  // namespace hysteron::blocks
