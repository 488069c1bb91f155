#include "blocks/linear/lead_lag.h"

namespace hysteron::blocks {

void LeadLag::describe(BlockSpec<LeadLag>& spec) {
  spec.name("lead_lag", "one zero and one pole by their corner frequencies").in_group("linear").elementwise().linear();
  spec.law("Y(s) = gain (1 + s/(2 pi zero))/(1 + s/(2 pi pole)) U(s)")
      .from("Franklin, Powell, Emami-Naeini, Feedback Control of Dynamic Systems, 8th ed. (2019), section 6.7");
  spec.remark(
      "A zero below the pole leads: most at sqrt(zero pole), by asin((pole - zero)/(pole + zero)); above it, it lags. The "
      "static gain is \"gain\", that of high frequencies gain pole/zero.");
  spec.remark("\"zero\": \"inf Hz\" leaves a low-pass of first order. A corner of 1 rad/s may be written \"1 rad/s\".");
  spec.input(&In<double>::u, "u", "$a", "the input");
  spec.state(&State<double>::x, "x", "$a", "the input behind the pole");
  spec.output(&Out<double>::y, "y", "$b", "the response");
  spec.param(&Params<double>::gain, "gain", "$b/$a", "static gain").optional("1").linear();
  spec.param(&Params<double>::zero, "zero", "Hz", "corner frequency of the zero").positive();
  spec.param(&Params<double>::pole, "pole", "Hz", "corner frequency of the pole").positive();
}

Kernel lead_lag_block() { return kernel<LeadLag>(); }

}  // namespace hysteron::blocks
