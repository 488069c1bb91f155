#include "blocks/sources/ramp.h"

namespace hysteron::blocks {

void Ramp::describe(BlockSpec<Ramp>& spec) {
  spec.name("ramp", "ramp that begins at a given time").in_group("sources");
  spec.law("y = initial + slope (t - time) for time <= t < time + duration, constant before and after")
      .from("definition");
  spec.remark(
      "Without a duration the ramp does not end. For a jerk-limited point-to-point motion use "
      "\"motion_profile\".");
  spec.output(&Out<double>::y, "y", "$a", "the signal");
  spec.param(&Params<double>::slope, "slope", "$a/s", "slope; negative = falling").linear().difference();
  spec.param(&Params<double>::time, "time", "s", "start of the ramp").optional("0 s");
  spec.param(&Params<double>::duration, "duration", "s", "duration of the ramp").optional("inf s").positive();
  spec.param(&Params<double>::initial, "initial", "$a", "value before the ramp").optional("0").offset();
}

Kernel ramp_block() { return kernel<Ramp>(); }

}  // namespace hysteron::blocks
