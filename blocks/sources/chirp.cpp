#include "blocks/sources/chirp.h"

namespace hysteron::blocks {

void Chirp::describe(BlockSpec<Chirp>& spec) {
  spec.name("chirp", "chirp: sine with a frequency sweep").in_group("sources");
  spec.law(
          "y = offset + amplitude sin(2 pi c(t) + phase), dc/dt = f(t); linear: f = from + (to - from) t/duration; "
          "logarithmic: f = from (to/from)^(t/duration)")
      .from("Farina, AES 108th Convention (2000), preprint 5093 (logarithmic sweep)");
  spec.remark(
      "After the sweep the sine continues at the final frequency with continuous phase; before t = 0 at "
      "the first one.");
  spec.output(&Out<double>::y, "y", "$a", "the signal");
  spec.param(&Params<double>::amplitude, "amplitude", "$a", "amplitude: half the peak-to-peak range")
      .linear()
      .difference();
  spec.param(&Params<double>::offset, "offset", "$a", "mean value").optional("0").offset();
  spec.param(&Params<double>::from, "from", "Hz", "frequency at t = 0").positive();
  spec.param(&Params<double>::to, "to", "Hz", "frequency at the end of the sweep").positive();
  spec.param(&Params<double>::duration, "duration", "s", "duration of the sweep").positive();
  spec.text("sweep", {"linear", "logarithmic"}, "how the frequency changes with time");
  spec.param(&Params<double>::phase, "phase", "deg", "phase at t = 0").optional("0 deg");
}

Kernel chirp_block() { return kernel<Chirp>(); }

}  // namespace hysteron::blocks
