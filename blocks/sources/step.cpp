#include "blocks/sources/step.h"

namespace hysteron::blocks {

void StepSource::describe(BlockSpec<StepSource>& spec) {
  spec.name("step", "one jump at a given time").in_group("sources");
  spec.law("y = before for t < time, after for t >= time").from("definition");
  spec.remark("It jumps: a law that is driven by the rate of its input (bouc_wen) needs a lag in between.");
  spec.output(&Out<double>::y, "y", "$a", "the level");
  spec.param(&Params<double>::before, "before", "$a", "level before the jump").optional("0").offset();
  spec.param(&Params<double>::after, "after", "$a", "level from the jump on").offset();
  spec.param(&Params<double>::time, "time", "s", "instant of the jump").optional("0 s");
}

Kernel step_block() { return kernel<StepSource>(); }

}  // namespace hysteron::blocks
