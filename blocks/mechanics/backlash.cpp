#include "blocks/mechanics/backlash.h"

namespace hysteron::blocks {

void Backlash::describe(BlockSpec<Backlash>& spec) {
  spec.name("backlash", "backlash: the driven side rests while the gap is crossed")
      .in_group("mechanics")
      .elementwise()
      .at("motion");
  spec.law("y = max(u - gap/2, min(u + gap/2, y before))").from("Nordin, Gutman, Automatica 38 (2002) 1633-1649");
  spec.remark("The driven side keeps its position while there is no contact, as if held by friction.");
  spec.remark(
      "This is the play operator of radius gap/2. The lost motion does not depend on the amplitude, unlike "
      "that of hysteresis.");
  spec.remembers("u", "the position of the driven side");
  spec.input(&In<double>::u, "u", "$a", "position of the driving side");
  spec.output(&Out<double>::y, "y", "$a", "position of the driven side");
  spec.param(&Params<double>::gap, "gap", "$a", "total width of the gap").not_negative().difference();
  spec.param(&Params<double>::before, "before", "$a",
             "input value visited before the start, which sets the initial memory")
      .optional("0");
  spec.memory(&Memory<double>::w, "w");
}

Kernel backlash_block() { return kernel<Backlash>(); }

}  // namespace hysteron::blocks
