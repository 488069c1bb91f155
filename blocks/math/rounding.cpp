#include "blocks/math/rounding.h"

namespace hysteron::blocks {

void Rounding::describe(BlockSpec<Rounding>& spec) {
  spec.name("rounding", "rounds to the nearest of levels that are a step apart")
      .in_group("math")
      .elementwise()
      .at("measured");
  spec.law("y = zero + step round((u - zero)/step)").from("Widrow, Kollar, Quantization Noise (2008), chapter 1");
  spec.remark("It rounds at every instant. For a converter with a sampling clock and a range use \"quantizer\".");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.output(&Out<double>::y, "y", "$a", "the rounded signal");
  spec.param(&Params<double>::step, "step", "$a", "distance between two levels; 0 = no rounding")
      .not_negative()
      .difference();
  spec.param(&Params<double>::zero, "zero", "$a",
             "one of the levels, e.g. \"0 degC\": in K zero is none of a thermometer's")
      .optional("0");
}

Kernel rounding_block() { return kernel<Rounding>(); }

}  // namespace hysteron::blocks
