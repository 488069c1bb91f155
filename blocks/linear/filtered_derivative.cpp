#include "blocks/linear/filtered_derivative.h"

namespace hysteron::blocks {

void FilteredDerivative::describe(BlockSpec<FilteredDerivative>& spec) {
  spec.name("filtered_derivative", "filtered derivative of its input").in_group("linear").elementwise().linear();
  spec.law("y = (u - x)/time, dx/dt = y: u s/(time s + 1)").from("definition");
  spec.remark("A step of the input gives a peak of height step/time. A pure derivative is not realisable.");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.state(&State<double>::x, "x", "$a", "the filtered signal");
  spec.output(&Out<double>::y, "y", "$a/s", "filtered derivative of the signal");
  spec.param(&Params<double>::time, "time", "s", "time constant of the filter").positive();
}

Kernel filtered_derivative_block() { return kernel<FilteredDerivative>(); }

}  // namespace hysteron::blocks
