#include "blocks/linear/lead_lag.h"

namespace hysteron::blocks {

void LeadLag::describe(BlockSpec<LeadLag>& spec) {
  spec.name("lead_lag", "lead-lag element: one zero and one pole").in_group("linear").elementwise().linear();
  spec.law("Y(s) = gain (1 + s/(2 pi zero))/(1 + s/(2 pi pole)) U(s)")
      .from("Franklin, Powell, Emami-Naeini, Feedback Control of Dynamic Systems, 8th ed. (2019), section 6.7");
  spec.remark(
      "A zero below the pole gives phase lead, at most asin((pole - zero)/(pole + zero)) at sqrt(zero "
      "pole); a zero above the pole gives phase lag. The static gain is \"gain\", the high-frequency gain "
      "is gain pole/zero.");
  spec.remark(
      "With \"zero\": \"inf Hz\" it is a first-order low-pass. Corner frequencies may also be given in "
      "rad/s: \"1 rad/s\".");
  spec.input(&In<double>::u, "u", "$a", "the input");
  spec.state(&State<double>::x, "x", "$a", "the input after the pole");
  spec.output(&Out<double>::y, "y", "$b", "the response");
  spec.param(&Params<double>::gain, "gain", "$b/$a", "static gain").optional("1").linear();
  spec.param(&Params<double>::zero, "zero", "Hz", "corner frequency of the zero").positive();
  spec.param(&Params<double>::pole, "pole", "Hz", "corner frequency of the pole").positive();
}

Kernel lead_lag_block() { return kernel<LeadLag>(); }

}  // namespace hysteron::blocks
