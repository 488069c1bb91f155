#include "blocks/measurement/periodic_error.h"

namespace hysteron::blocks {

void PeriodicError::describe(BlockSpec<PeriodicError>& spec) {
  spec.name("periodic_error", "adds an error that is periodic in the position");
  spec.in_group("measurement").elementwise().at("measured");
  spec.law(
          "y = u + cosine cos(2 pi u/period) + sine sin(2 pi u/period) + second_cosine cos(4 pi u/period) + second_sine "
          "sin(4 pi u/period)")
      .from("Heydemann, Applied Optics 20 (1981) 3382-3384 (interpolation of two signals)");
  spec.remark(
      "Examples: the interpolation error of an encoder, resolver or interferometer, with one and two "
      "periods per signal period; the error of a screw, with one period per turn. For an encoder with "
      "quantization use \"encoder\" or \"linear_encoder\".");
  spec.input(&In<double>::u, "u", "$a", "the position");
  spec.output(&Out<double>::y, "y", "$a", "position with the error");
  spec.param(&Params<double>::period, "period", "$a", "period of the error along the position, e.g. \"0.25 mm\"")
      .positive()
      .difference();
  spec.param(&Params<double>::cosine, "cosine", "$a", "cosine amplitude, one per period")
      .optional("0")
      .difference()
      .linear();
  spec.param(&Params<double>::sine, "sine", "$a", "sine amplitude, one per period").optional("0").difference().linear();
  spec.param(&Params<double>::second_cosine, "second_cosine", "$a", "cosine amplitude, two per period")
      .optional("0")
      .difference()
      .linear();
  spec.param(&Params<double>::second_sine, "second_sine", "$a", "sine amplitude, two per period")
      .optional("0")
      .difference()
      .linear();
}

Kernel periodic_error_block() { return kernel<PeriodicError>(); }

}  // namespace hysteron::blocks
