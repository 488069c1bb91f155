#include "blocks/logic/compare.h"

namespace hysteron::blocks {

void Compare::describe(BlockSpec<Compare>& spec) {
  spec.name("compare", "compares two signals: output 1 or 0").in_group("logic").elementwise();
  spec.law("y = 1 if \"a is b\" holds, else 0").from("definition");
  spec.remark("The instants at which the result changes are located. To compare with a constant use \"comparator\".");
  spec.remark(
      "Continuous signals are equal for an instant only; use equality for signals with whole values (0, 1, "
      "2).");
  spec.input(&In<double>::a, "a", "$a", "left-hand side");
  spec.input(&In<double>::b, "b", "$a", "right-hand side");
  spec.output(&Out<double>::y, "y", "", "1 = true, 0 = false");
  spec.text("is", {"less", "at_most", "equal", "not_equal", "at_least", "greater"}, "relation: a is less than b, ...");
}

void Comparator::describe(BlockSpec<Comparator>& spec) {
  spec.name("comparator", "comparator: one of two values, above or below a level").in_group("logic").elementwise();
  spec.law("y = above if u > level, else below").from("definition");
  spec.remark("It has no hysteresis: noise about the level causes repeated switching. For hysteresis use \"relay\".");
  spec.remark("The switching instants are located. The output jumps.");
  spec.input(&In<double>::u, "u", "$a", "the signal to compare with the level");
  spec.output(&Out<double>::y, "y", "$b", "the value above or below");
  spec.param(&Params<double>::level, "level", "$a", "level that the input is compared with");
  spec.param(&Params<double>::above, "above", "$b", "output while the input is above the level").linear();
  spec.param(&Params<double>::below, "below", "$b", "output while the input is at or below the level").linear();
}

Kernel compare_block() { return kernel<Compare>(); }
Kernel comparator_block() { return kernel<Comparator>(); }

}  // namespace hysteron::blocks
