#include "blocks/mechanics/backlash.h"

namespace hysteron::blocks {

void Backlash::describe(BlockSpec<Backlash>& spec) {
  spec.name("backlash", "joint with a gap: the driven side rests while the gap is crossed")
      .in_group("mechanics")
      .elementwise()
      .at("motion");
  spec.law("y = max(u - gap/2, min(u + gap/2, y before))").from("Nordin, Gutman, Automatica 38 (2002) 1633-1649");
  spec.remark("The driven side keeps its place while the joint is loose: friction holds it.");
  spec.remark(
      "The play operator of radius gap/2. The lost motion does not grow with the amplitude; that of hysteresis does.");
  spec.remembers("u", "the position of the driven side");
  spec.input(&In<double>::u, "u", "$a", "position of the driving side");
  spec.output(&Out<double>::y, "y", "$a", "position of the driven side");
  spec.param(&Params<double>::gap, "gap", "$a", "total gap").not_negative().difference();
  spec.param(&Params<double>::before, "before", "$a", "an input that was visited before the start").optional("0");
  spec.memory(&Memory<double>::w, "w");
}

Kernel backlash_block() { return kernel<Backlash>(); }

}  // namespace hysteron::blocks
