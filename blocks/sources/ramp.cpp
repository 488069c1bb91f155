#include "blocks/sources/ramp.h"

namespace hysteron::blocks {

void Ramp::describe(BlockSpec<Ramp>& spec) {
  spec.name("ramp", "a straight line that begins at a given time").in_group("sources");
  spec.law("y = initial + slope (t - time) for time <= t < time + duration, constant before and behind")
      .from("definition");
  spec.remark("Without a duration it goes on for ever. A jerk-limited move from place to place is \"motion_profile\".");
  spec.output(&Out<double>::y, "y", "$a", "the signal");
  spec.param(&Params<double>::slope, "slope", "$a/s", "how fast it rises; negative: falls").linear().difference();
  spec.param(&Params<double>::time, "time", "s", "instant at which it begins").optional("0 s");
  spec.param(&Params<double>::duration, "duration", "s", "how long it lasts").optional("inf s").positive();
  spec.param(&Params<double>::initial, "initial", "$a", "value before it begins").optional("0").offset();
}

Kernel ramp_block() { return kernel<Ramp>(); }

}  // namespace hysteron::blocks
