#include "blocks/math/absolute.h"

namespace hysteron::blocks {

void Absolute::describe(BlockSpec<Absolute>& spec) {
  spec.name("abs", "the absolute value").in_group("math").elementwise().law("y = |u|").from("definition");
  spec.remark("It bends at zero, which is located. Only a share of it is a \"rectifier\".");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.output(&Out<double>::y, "y", "$a", "its size");
}

void Sign::describe(BlockSpec<Sign>& spec) {
  spec.name("sign", "1, 0 or -1: the direction of a signal").in_group("math").elementwise();
  spec.law("y = 1 if u > 0, -1 if u < 0, else 0").from("definition");
  spec.remark(
      "It jumps at zero, which is located. Friction is none of it: a sign of a velocity in a loop chatters; "
      "\"mass_with_friction\" sticks.");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.output(&Out<double>::y, "y", "", "its sign");
}

Kernel abs_block() { return kernel<Absolute>(); }
Kernel sign_block() { return kernel<Sign>(); }

}  // namespace hysteron::blocks
