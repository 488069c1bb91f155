#include "blocks/continuous/limited_integrator.h"

#include <fmt/format.h>

namespace hysteron::blocks {

template <bool resets>
void LimitedIntegrator<resets>::describe(BlockSpec<LimitedIntegrator>& spec) {
  using I = In<double>;
  if (resets)
    spec.name("integrator_with_reset", "integrator with limits that a signal resets");
  else
    spec.name("limited_integrator", "integrator with limits");
  spec.in_group("continuous").elementwise();
  spec.law(resets ? "dy/dt = u between lower and upper, 0 at a limit while u points beyond it; y = start when reset "
                    "rises above 0.5 (rising), falls below 0.5 (falling), does either, or while it is above 0.5 "
                    "(while_on)"
                  : "dy/dt = u between lower and upper, 0 at a limit while u points beyond it")
      .from("definition");
  spec.remark("The integral leaves a limit as soon as u changes sign: there is no windup.");
  if (resets)
    spec.remark(
        "A reset signal that is already on at the start of the run resets the integral then. start is read "
        "only at the instant of a reset.");
  spec.input(&I::u, "u", "$a", "the signal to integrate");
  if constexpr (resets) {
    spec.input(&I::reset, "reset", "", "reset signal: above 0.5 is on");
    spec.input(&I::start, "start", "$a*s", "value that the integral is reset to");
  }
  spec.state(&State<double>::x, "x", "$a*s", "the integral");
  spec.output(&Out<double>::y, "y", "$a*s", "the integral");
  spec.param(&Params<double>::lower, "lower", "$a*s", "lower limit of the integral").optional("-inf");
  spec.param(&Params<double>::upper, "upper", "$a*s", "upper limit of the integral").optional("inf");
  spec.param(&Params<double>::initial, "initial", "$a*s", "initial value of the integral").optional("0");
  if (resets)
    spec.text("reset_at", {"rising", "falling", "either", "while_on"},
              "which edge or level of the signal resets the integral");
}

template <bool resets>
std::string LimitedIntegrator<resets>::check(const Params<double>& p) {
  if (!(p.lower < p.upper)) return "lower, {lower}, is not below upper, {upper}; exchange them";
  if (p.initial < p.lower || p.initial > p.upper)
    return "the initial value, {initial}, is not between the limits; give initial from {lower} to {upper}";
  return "";
}

Kernel limited_integrator_block() { return kernel<LimitedIntegrator<false>>(); }
Kernel integrator_with_reset_block() { return kernel<LimitedIntegrator<true>>(); }

}  // namespace hysteron::blocks
