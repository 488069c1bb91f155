#include "blocks/sampled/discrete_integrator.h"

namespace hysteron::blocks {

void DiscreteIntegrator::describe(Declaration& d) {
  d.name("discrete_integrator", "discrete-time integrator").in_group("sampled").elementwise().linear();
  d.law(
       "forward: y_k = x_k; backward: y_k = x_k + T u_k; trapezoidal: y_k = x_k + T u_k/2; x_(k+1) = x_k + T u_k, x_0 = "
       "initial, T = period")
      .from("Franklin, Powell, Workman, Digital Control of Dynamic Systems, 3rd ed. (1998), section 6.1");
  d.remark("\"forward\" has no direct feedthrough, so a loop of sampled blocks can be closed around it.");
  d.remark(
      "For limits and anti-windup use \"discrete_pid\" with \"kp\": 0; for continuous time use "
      "\"integrator\".");
  d.input("u", "$a", "the signal to integrate");
  d.output("y", "$a*s", "the integral");
  d.state("x", "$a*s", "the integral up to the present instant");
  d.text("rule", {"forward", "backward", "trapezoidal"},
         "integration rule: forward Euler, backward Euler or trapezoidal");
  d.parameter("initial", "$a*s", "initial value of the integral, before the first sample is added")
      .optional("0")
      .offset();
  d.sampled();
}

Sizes DiscreteIntegrator::sizes(const Shape& shape) {
  Sizes s;
  s.sampled_states = 1;
  s.feedthrough = shape.text("rule") != "forward";
  return s;
}

void DiscreteIntegrator::initial_states(const View<double>& v) { v.out[0] = v.parameter(initial); }

Kernel discrete_integrator_block() { return kernel<DiscreteIntegrator>(); }

}  // namespace hysteron::blocks
