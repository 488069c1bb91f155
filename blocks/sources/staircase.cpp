#include "blocks/sources/staircase.h"

namespace hysteron::blocks {

void Staircase::describe(Declaration& d) {
  d.name("staircase", "staircase: levels of equal duration").in_group("sources");
  d.law("y = levels[k] for k duration <= t < (k + 1) duration").from("definition");
  d.remark("The last level is held to the end; before t = 0 the first one applies.");
  d.remark(
      "The output jumps: a block that is driven by the rate of its input (e.g. bouc_wen) needs a lag in "
      "between.");
  d.output("y", "$a", "the level");
  d.list("levels", "$a", "the levels, in order").offset();
  d.parameter("duration", "s", "duration of each level").positive();
}

Sizes Staircase::sizes(const Shape& shape) {
  Sizes s;
  s.feedthrough = false;
  s.smoothness = Smoothness::jumps;
  if (shape.length("levels") < 1) s.error = "\"levels\" is empty; give at least one level";
  return s;
}

Kernel staircase_block() { return kernel<Staircase>(); }

}  // namespace hysteron::blocks
