#include "blocks/linear/notch.h"

namespace hysteron::blocks {

void Notch::describe(BlockSpec<Notch>& spec) {
  spec.name("notch", "notch filter at one frequency").in_group("linear").elementwise().linear();
  spec.law("Y(s) = (s^2 + 2 depth damping w s + w^2)/(s^2 + 2 damping w s + w^2) U(s), w = 2 pi frequency")
      .from("Franklin, Powell, Emami-Naeini, Feedback Control of Dynamic Systems, 8th ed. (2019), section 6.7");
  spec.remark(
      "To cancel a resonance of damping ratio z at the same frequency: choose \"damping\" for the new "
      "poles (0.5 to 1) and depth = z/damping. A depth above 1 gives a peak.");
  spec.remark("For zeros and poles at different frequencies use \"biquads\".");
  spec.input(&In<double>::u, "u", "$a", "the input");
  spec.state(&State<double>::q, "q", "$a", "the input after the poles");
  spec.state(&State<double>::v, "v", "$a", "rate of q over w");
  spec.output(&Out<double>::y, "y", "$a", "the filtered signal");
  spec.param(&Params<double>::frequency, "frequency", "Hz", "centre frequency of the notch").positive();
  spec.param(&Params<double>::damping, "damping", "",
             "damping ratio of the poles: half the relative width of the notch")
      .positive();
  spec.param(&Params<double>::depth, "depth", "", "gain at the centre frequency; 0 = complete suppression")
      .optional("0")
      .linear()
      .not_negative();
}

Kernel notch_block() { return kernel<Notch>(); }

}  // namespace hysteron::blocks
