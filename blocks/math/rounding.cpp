#include "blocks/math/rounding.h"

namespace hysteron::blocks {

void Rounding::describe(BlockSpec<Rounding>& spec) {
  spec.name("rounding", "rounds to the nearest multiple of a step").in_group("math").elementwise().at("measured");
  spec.law("y = step round(u/step)").from("Widrow, Kollar, Quantization Noise (2008), chapter 1");
  spec.remark("It rounds at every instant. For a converter with a sampling clock and a range use \"quantizer\".");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.output(&Out<double>::y, "y", "$a", "the rounded signal");
  spec.param(&Params<double>::step, "step", "$a", "distance between two levels; 0 = no rounding")
      .not_negative()
      .difference();
}

Kernel rounding_block() { return kernel<Rounding>(); }

}  // namespace hysteron::blocks
