#include "blocks/math/rounding.h"

namespace hysteron::blocks {

void Rounding::describe(BlockSpec<Rounding>& spec) {
  spec.name("rounding", "the nearest multiple of a step").in_group("math").elementwise().at("measured");
  spec.law("y = step round(u/step)").from("Widrow, Kollar, Quantization Noise (2008), chapter 1");
  spec.remark("It rounds at every instant. A converter with a clock and a range is \"quantizer\".");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.output(&Out<double>::y, "y", "$a", "the rounded signal");
  spec.param(&Params<double>::step, "step", "$a", "between two levels; 0 = nothing is rounded")
      .not_negative()
      .difference();
}

Kernel rounding_block() { return kernel<Rounding>(); }

}  // namespace hysteron::blocks
