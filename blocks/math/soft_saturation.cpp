#include "blocks/math/soft_saturation.h"

namespace hysteron::blocks {

void SoftSaturation::describe(BlockSpec<SoftSaturation>& spec) {
  spec.name("soft_saturation", "smooth symmetric saturation").in_group("math").elementwise();
  spec.law("y = u/(1 + |u/limit|^sharpness)^(1/sharpness)").from("Rapp, ESA SP-332 (1991) 179-184 (amplifier knee)");
  spec.remark(
      "Far below the limit the input passes unchanged. A large sharpness approaches a hard limit; 2 gives "
      "a wide knee.");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.output(&Out<double>::y, "y", "$a", "the limited signal");
  spec.param(&Params<double>::limit, "limit", "$a", "limit that the magnitude of the output approaches")
      .positive()
      .difference();
  spec.param(&Params<double>::sharpness, "sharpness", "", "sharpness of the knee, at least 1").optional("2").minimum =
      1;
}

Kernel soft_saturation_block() { return kernel<SoftSaturation>(); }

}  // namespace hysteron::blocks
