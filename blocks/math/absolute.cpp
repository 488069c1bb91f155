#include "blocks/math/absolute.h"

namespace hysteron::blocks {

void Absolute::describe(BlockSpec<Absolute>& spec) {
  spec.name("abs", "absolute value").in_group("math").elementwise().law("y = |u|").from("definition");
  spec.remark("It has a kink at zero, whose crossing is located. For a partly rectified signal use \"rectifier\".");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.output(&Out<double>::y, "y", "$a", "absolute value of the signal");
}

void Sign::describe(BlockSpec<Sign>& spec) {
  spec.name("sign", "sign of a signal: 1, 0 or -1").in_group("math").elementwise();
  spec.law("y = 1 if u > 0, -1 if u < 0, else 0").from("definition");
  spec.remark(
      "It jumps at zero, whose crossing is located. Do not use it for friction: the sign of a velocity in "
      "a loop chatters; use \"mass_with_friction\", which sticks.");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.output(&Out<double>::y, "y", "", "its sign");
}

Kernel abs_block() { return kernel<Absolute>(); }
Kernel sign_block() { return kernel<Sign>(); }

}  // namespace hysteron::blocks
