#include "blocks/linear/filtered_derivative.h"

namespace hysteron::blocks {

void FilteredDerivative::describe(BlockSpec<FilteredDerivative>& spec) {
  spec.name("filtered_derivative", "rate of its input, behind a lag").in_group("linear").elementwise().linear();
  spec.law("y = (u - x)/time, dx/dt = y: u s/(time s + 1)").from("definition");
  spec.remark("A jump of the input is a peak of its height over time. Nothing in nature differentiates without a lag.");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.state(&State<double>::x, "x", "$a", "the signal behind the lag");
  spec.output(&Out<double>::y, "y", "$a/s", "its rate");
  spec.param(&Params<double>::time, "time", "s", "time constant of the lag").positive();
}

Kernel filtered_derivative_block() { return kernel<FilteredDerivative>(); }

}  // namespace hysteron::blocks
