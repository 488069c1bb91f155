#include "blocks/continuous/limited_integrator.h"

#include <fmt/format.h>

namespace hysteron::blocks {

template <bool resets>
void LimitedIntegrator<resets>::describe(BlockSpec<LimitedIntegrator>& spec) {
  using I = In<double>;
  if (resets)
    spec.name("integrator_with_reset", "integral of its input over time, that a signal sets anew, between limits");
  else
    spec.name("limited_integrator", "integral of its input over time, that stops at limits");
  spec.in_group("continuous").elementwise();
  spec.law(resets
               ? "dy/dt = u between lower and upper, 0 at a limit that u presses against; y = start when reset rises "
                 "above 0.5 (falls below it, either, or is held there while it is above)"
               : "dy/dt = u between lower and upper, 0 at a limit that u presses against")
      .from("definition");
  spec.remark("It leaves a limit at once when u turns: nothing is wound up.");
  if (resets)
    spec.remark("A signal that is on at the start sets it then. start is read at the instant of the reset only.");
  spec.input(&I::u, "u", "$a", "what is integrated");
  if constexpr (resets) {
    spec.input(&I::reset, "reset", "", "0 or 1");
    spec.input(&I::start, "start", "$a*s", "where it begins anew");
  }
  spec.state(&State<double>::x, "x", "$a*s", "the integral");
  spec.output(&Out<double>::y, "y", "$a*s", "the integral");
  spec.param(&Params<double>::lower, "lower", "$a*s", "smallest value").optional("-inf");
  spec.param(&Params<double>::upper, "upper", "$a*s", "largest value").optional("inf");
  spec.param(&Params<double>::initial, "initial", "$a*s", "value at the start").optional("0");
  if (resets) spec.text("reset_at", {"rising", "falling", "either", "while_on"}, "when the signal sets it anew");
}

template <bool resets>
std::string LimitedIntegrator<resets>::check(const Params<double>& p) {
  if (!(p.lower < p.upper)) return "lower, {lower}, is not below upper, {upper}; exchange them";
  if (p.initial < p.lower || p.initial > p.upper)
    return "the start at {initial} is not between the limits; give initial from {lower} to {upper}";
  return "";
}

Kernel limited_integrator_block() { return kernel<LimitedIntegrator<false>>(); }
Kernel integrator_with_reset_block() { return kernel<LimitedIntegrator<true>>(); }

}  // namespace hysteron::blocks
