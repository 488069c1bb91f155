#include "blocks/continuous/creep.h"

namespace hysteron::blocks {

void Creep::describe(Declaration& d) {
  d.name("creep", "slow continuation of a move (Kelvin-Voigt chain)")
      .in_group("continuous")
      .elementwise()
      .linear()
      .at("core");
  d.law("y = u + sum amounts[k] x_k, times[k] dx_k/dt = u - x_k")
      .from("Croft, Shed, Devasia, J. Dyn. Sys. Meas. Control 123 (2001) 35-43");
  d.remark(
      "For the logarithmic creep of piezoceramics take equal amounts (0.01 to 0.02 per decade) at times a factor of "
      "ten apart.");
  d.remark("The amounts come on top: in the end the gain is 1 + sum of amounts.");
  d.input("u", "$a", "the signal without creep");
  d.output("y", "$a", "the signal with creep");
  d.state("x", "$a", "relaxed signal of each element");
  d.list("amounts", "", "share of the move that each element adds in the end").linear().not_negative();
  d.list("times", "s", "time constant of each element").positive().as_long_as("amounts");
}

Sizes Creep::sizes(const Shape& shape) {
  Sizes s;
  s.states = shape.length("times");
  if (s.states < 1 || s.states != shape.length("amounts"))
    s.error = "\"amounts\" and \"times\" must be lists of one length; give one amount per time constant";
  return s;
}

Kernel creep_block() { return kernel<Creep>(); }

}  // namespace hysteron::blocks
