#include "blocks/sources/step.h"

namespace hysteron::blocks {

void StepSource::describe(BlockSpec<StepSource>& spec) {
  spec.name("step", "step at a given time").in_group("sources");
  spec.law("y = before for t < time, after for t >= time").from("definition");
  spec.remark(
      "The output jumps: a block that is driven by the rate of its input (e.g. bouc_wen) needs a lag in "
      "between.");
  spec.output(&Out<double>::y, "y", "$a", "the level");
  spec.param(&Params<double>::before, "before", "$a", "level before the step").optional("0").offset();
  spec.param(&Params<double>::after, "after", "$a", "level after the step").offset();
  spec.param(&Params<double>::time, "time", "s", "time of the step").optional("0 s");
}

Kernel step_block() { return kernel<StepSource>(); }

}  // namespace hysteron::blocks
