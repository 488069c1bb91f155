#include "blocks/sources/sine.h"

namespace hysteron::blocks {

void Sine::describe(BlockSpec<Sine>& spec) {
  spec.name("sine", "sine wave with an offset").in_group("sources");
  spec.law("y = offset + amplitude sin(2 pi frequency t + phase)")
      .from("thesis Eq. 2.40 is phase = -90 deg, offset = amplitude");
  spec.remark("With \"phase\": \"-90 deg\" the signal starts at its minimum.");
  spec.output(&Out<double>::y, "y", "$a", "the signal");
  spec.param(&Params<double>::amplitude, "amplitude", "$a", "amplitude: half the peak-to-peak range")
      .linear()
      .difference();
  spec.param(&Params<double>::offset, "offset", "$a", "mean value").optional("0").offset();
  spec.param(&Params<double>::frequency, "frequency", "Hz", "frequency, in periods per second").positive();
  spec.param(&Params<double>::phase, "phase", "deg", "phase at t = 0").optional("0 deg");
}

Kernel sine_block() { return kernel<Sine>(); }

}  // namespace hysteron::blocks
