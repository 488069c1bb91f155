#include "blocks/math/rectifier.h"

namespace hysteron::blocks {

void Rectifier::describe(BlockSpec<Rectifier>& spec) {
  spec.name("rectifier", "rectifier: mixes a signal with its absolute value")
      .in_group("math")
      .elementwise()
      .at("command");
  spec.law("y = (1 - mix) u + mix |u|").from("definition; mix 1: absolute value, 0.5: nothing below zero");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.output(&Out<double>::y, "y", "$a", "the rectified signal");
  spec.param(&Params<double>::mix, "mix", "", "0 = no rectification, 0.5 = half-wave, 1 = full-wave (absolute value)")
      .linear();
}

Kernel rectifier_block() { return kernel<Rectifier>(); }

}  // namespace hysteron::blocks
