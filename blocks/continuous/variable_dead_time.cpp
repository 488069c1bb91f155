#include "blocks/continuous/variable_dead_time.h"

namespace hysteron::blocks {

void VariableDeadTime::describe(Declaration& d) {
  d.name("variable_dead_time", "dead time that is set by a signal").in_group("continuous");
  d.law("y(t) = u(t - delay(t)), 0 <= delay <= longest; before the start the input is taken as constant")
      .from("definition");
  d.remark("For transport through a pipe at a varying speed: delay = length/speed, with the present speed.");
  d.remark(
      "Where the delay is shorter than the solver's step, the input is extrapolated linearly from the last "
      "accepted step (first-order accurate). To avoid this set \"max_step\" of the solver to the shortest "
      "delay.");
  d.input("u", "$a", "the signal");
  d.input("delay", "s", "dead time; limited to 0 .. longest");
  d.output("y", "$a", "the delayed signal");
  d.parameter("longest", "s", "longest delay; sets how much of the past is stored").positive();
}

Sizes VariableDeadTime::sizes(const Shape&) {
  Sizes s;
  s.history = true;
  s.kinks = 2;
  return s;
}

Kernel variable_dead_time_block() { return kernel<VariableDeadTime>(); }

}  // namespace hysteron::blocks
