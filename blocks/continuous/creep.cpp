#include "blocks/continuous/creep.h"

namespace hysteron::blocks {

void Creep::describe(Declaration& d) {
  d.name("creep", "creep: slow motion after a step (Kelvin-Voigt chain)")
      .in_group("continuous")
      .elementwise()
      .linear()
      .at("core");
  d.law("y = u + sum amounts[k] x_k, times[k] dx_k/dt = u - x_k")
      .from("Croft, Shed, Devasia, J. Dyn. Sys. Meas. Control 123 (2001) 35-43");
  d.remark(
      "For the logarithmic creep of piezoceramics use equal amounts (0.01 to 0.02 per decade) with time "
      "constants a factor of ten apart.");
  d.remark("Creep adds to the input: the static gain is 1 + sum of amounts.");
  d.input("u", "$a", "the signal without creep");
  d.output("y", "$a", "the signal with creep");
  d.state("x", "$a", "relaxed signal of each element");
  d.list("amounts", "", "final creep of each element, relative to the step").linear().not_negative();
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
