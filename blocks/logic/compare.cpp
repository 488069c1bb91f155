#include "blocks/logic/compare.h"

namespace hysteron::blocks {

void Compare::describe(BlockSpec<Compare>& spec) {
  spec.name("compare", "is one signal less than another, equal, greater: 1 or 0").in_group("logic").elementwise();
  spec.law("y = 1 if \"a is b\" holds, else 0").from("definition");
  spec.remark("The instants at which the answer changes are located. Against a level: \"comparator\".");
  spec.remark("Signals that move are equal for an instant only; what counts (0, 1, 2) can be asked for equality.");
  spec.input(&In<double>::a, "a", "$a", "what stands on the left");
  spec.input(&In<double>::b, "b", "$a", "what stands on the right");
  spec.output(&Out<double>::y, "y", "", "1 = true, 0 = false");
  spec.text("is", {"less", "at_most", "equal", "not_equal", "at_least", "greater"},
            "what is asked: a is less than b ...");
}

void Comparator::describe(BlockSpec<Comparator>& spec) {
  spec.name("comparator", "one of two values, above or below a level").in_group("logic").elementwise();
  spec.law("y = above if u > level, else below").from("definition");
  spec.remark("Without hysteresis: noise about the level switches it to and fro. With it: \"relay\".");
  spec.remark("The switching instants are located. The output jumps.");
  spec.input(&In<double>::u, "u", "$a", "what is held against the level");
  spec.output(&Out<double>::y, "y", "$b", "the value in force");
  spec.param(&Params<double>::level, "level", "$a", "the level");
  spec.param(&Params<double>::above, "above", "$b", "output above it").linear();
  spec.param(&Params<double>::below, "below", "$b", "output at the level and below").linear();
}

Kernel compare_block() { return kernel<Compare>(); }
Kernel comparator_block() { return kernel<Comparator>(); }

}  // namespace hysteron::blocks
