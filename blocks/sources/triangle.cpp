#include "blocks/sources/triangle.h"

namespace hysteron::blocks {

void Triangle::describe(BlockSpec<Triangle>& spec) {
  spec.name("triangle", "triangle wave with an offset").in_group("sources");
  spec.law("y = offset + amplitude (2/pi) asin(sin(2 pi frequency t + phase))")
      .from("thesis Eq. 2.41 is phase = -90 deg, offset = amplitude");
  spec.remark(
      "Zero crossings and extremes coincide with those of a sine of the same phase; the slope is +-4 "
      "amplitude frequency.");
  spec.output(&Out<double>::y, "y", "$a", "the signal");
  spec.param(&Params<double>::amplitude, "amplitude", "$a", "amplitude: half the peak-to-peak range")
      .linear()
      .difference();
  spec.param(&Params<double>::offset, "offset", "$a", "mean value").optional("0").offset();
  spec.param(&Params<double>::frequency, "frequency", "Hz", "frequency, in periods per second").positive();
  spec.param(&Params<double>::phase, "phase", "deg", "phase at t = 0").optional("0 deg");
}

Kernel triangle_block() { return kernel<Triangle>(); }

}  // namespace hysteron::blocks
