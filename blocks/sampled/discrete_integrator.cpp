#include "blocks/sampled/discrete_integrator.h"

namespace hysteron::blocks {

void DiscreteIntegrator::describe(Declaration& d) {
  d.name("discrete_integrator", "sum of its samples times the period").in_group("sampled").elementwise().linear();
  d.law(
       "forward: y_k = x_k; backward: y_k = x_k + T u_k; trapezoidal: y_k = x_k + T u_k/2; x_(k+1) = x_k + T u_k, x_0 = "
       "initial, T = period")
      .from("Franklin, Powell, Workman, Digital Control of Dynamic Systems, 3rd ed. (1998), section 6.1");
  d.remark(
      "\"forward\" does not need its input at the same instant, so a loop of sampled blocks can be closed around it.");
  d.remark(
      "With limits and anti-windup an integral is \"discrete_pid\" with \"kp\": 0; the continuous one is \"integrator\".");
  d.input("u", "$a", "what is integrated");
  d.output("y", "$a*s", "the integral");
  d.state("x", "$a*s", "the integral up to the instant");
  d.text("rule", {"forward", "backward", "trapezoidal"}, "how the samples stand for the signal between them");
  d.parameter("initial", "$a*s", "integral at the first instant, without the sample there").optional("0").offset();
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
