#include "blocks/linear/notch.h"

namespace hysteron::blocks {

void Notch::describe(BlockSpec<Notch>& spec) {
  spec.name("notch", "takes one frequency out").in_group("linear").elementwise().linear();
  spec.law("Y(s) = (s^2 + 2 depth damping w s + w^2)/(s^2 + 2 damping w s + w^2) U(s), w = 2 pi frequency")
      .from("Franklin, Powell, Emami-Naeini, Feedback Control of Dynamic Systems, 8th ed. (2019), section 6.7");
  spec.remark(
      "Against a resonance of damping z and the same frequency: \"damping\" where the poles shall be (0.5 to 1), \"depth\" "
      "z/damping. A depth above 1 makes a peak.");
  spec.remark("Zeros and poles at frequencies of their own: \"biquads\".");
  spec.input(&In<double>::u, "u", "$a", "the input");
  spec.state(&State<double>::q, "q", "$a", "the input behind the poles");
  spec.state(&State<double>::v, "v", "$a", "its rate over w");
  spec.output(&Out<double>::y, "y", "$a", "the input without the frequency");
  spec.param(&Params<double>::frequency, "frequency", "Hz", "what is taken out").positive();
  spec.param(&Params<double>::damping, "damping", "", "damping ratio of the poles: half the width over the frequency")
      .positive();
  spec.param(&Params<double>::depth, "depth", "", "gain at the frequency; 0 = nothing passes")
      .optional("0")
      .linear()
      .not_negative();
}

Kernel notch_block() { return kernel<Notch>(); }

}  // namespace hysteron::blocks
