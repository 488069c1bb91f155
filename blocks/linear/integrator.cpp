#include "blocks/linear/integrator.h"

namespace hysteron::blocks {

void Integrator::describe(BlockSpec<Integrator>& spec) {
  spec.name("integrator", "integrates its input over time").in_group("linear").elementwise().linear();
  spec.law("dy/dt = u, y(0) = initial").from("definition");
  spec.remark(
      "An integrator has no equilibrium of its own: where a simulation starts in steady state, it keeps "
      "its initial value.");
  spec.variation("friction", "integrator_with_friction", {{"level", "0"}});
  spec.input(&In<double>::u, "u", "$a", "the signal to integrate");
  spec.state(&State<double>::x, "x", "$a*s", "the integral");
  spec.output(&Out<double>::y, "y", "$a*s", "the integral");
  spec.param(&Params<double>::initial, "initial", "$a*s", "initial value of the integral").optional("0").offset();
}

Kernel integrator_block() { return kernel<Integrator>(); }

}  // namespace hysteron::blocks
