#include "blocks/measurement/periodic_error.h"

namespace hysteron::blocks {

void PeriodicError::describe(BlockSpec<PeriodicError>& spec) {
  spec.name("periodic_error", "a position with an error that comes again at the same positions");
  spec.in_group("measurement").elementwise().at("measured");
  spec.law(
          "y = u + cosine cos(2 pi u/period) + sine sin(2 pi u/period) + second_cosine cos(4 pi u/period) + second_sine "
          "sin(4 pi u/period)")
      .from("Heydemann, Applied Optics 20 (1981) 3382-3384 (interpolation of two signals)");
  spec.remark(
      "Of an encoder, a resolver or an interferometer once and twice per period of its signals; of a screw once a turn. An "
      "encoder that counts is \"encoder\" or \"linear_encoder\".");
  spec.input(&In<double>::u, "u", "$a", "the position");
  spec.output(&Out<double>::y, "y", "$a", "what is read, or passed on");
  spec.param(&Params<double>::period, "period", "$a", "after which the error comes again, e.g. \"0.25 mm\"")
      .positive()
      .difference();
  spec.param(&Params<double>::cosine, "cosine", "$a", "once a period: cosine").optional("0").difference().linear();
  spec.param(&Params<double>::sine, "sine", "$a", "once a period: sine").optional("0").difference().linear();
  spec.param(&Params<double>::second_cosine, "second_cosine", "$a", "twice a period: cosine")
      .optional("0")
      .difference()
      .linear();
  spec.param(&Params<double>::second_sine, "second_sine", "$a", "twice a period: sine")
      .optional("0")
      .difference()
      .linear();
}

Kernel periodic_error_block() { return kernel<PeriodicError>(); }

}  // namespace hysteron::blocks
