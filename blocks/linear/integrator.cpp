#include "blocks/linear/integrator.h"

namespace hysteron::blocks {

void Integrator::describe(BlockSpec<Integrator>& spec) {
  spec.name("integrator", "integral of its input over time").in_group("linear").elementwise().linear();
  spec.law("dy/dt = u, y(0) = initial").from("definition");
  spec.remark("It has no equilibrium of its own: where a simulation starts at rest it keeps its initial value.");
  spec.input(&In<double>::u, "u", "$a", "what is integrated");
  spec.state(&State<double>::x, "x", "$a*s", "the integral");
  spec.output(&Out<double>::y, "y", "$a*s", "the integral");
  spec.param(&Params<double>::initial, "initial", "$a*s", "value at the start").optional("0").offset();
}

Kernel integrator_block() { return kernel<Integrator>(); }

}  // namespace hysteron::blocks
