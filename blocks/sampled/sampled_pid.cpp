#include "blocks/sampled/sampled_pid.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void SampledPid::describe(BlockSpec<SampledPid>& spec) {
  spec.name("sampled_pid", "digital PI or PID controller of the control error").in_group("sampled").elementwise();
  spec.law(
          "y = sat(kp e + I + D), D_k = (filter D_(k-1) + kd (e_k - e_(k-1)))/(filter + T); forward: I = I_k, "
          "I_(k+1) = I_k + ki T e_k; backward: with e_k at once; trapezoidal: with (e_k + e_(k-1))/2 at once; "
          "clamping: an increment that pushes the command beyond a limit is not kept in I; back_calculation: "
          "I_(k+1) += T/tracking_time (sat(y) - y)")
      .from("thesis section 2.3 (forward rule); Astrom, Hagglund, Advanced PID Control (2006)");
  spec.remark("The input is the control error, reference minus measured value: a sum with \"signs\": \"+-\".");
  spec.remark("For no limit write \"-inf V\" or \"inf V\", in the unit of the command.");
  spec.remark(
      "The rule forward (the one of the thesis) does not use the present error in the integral; for a "
      "plant sampled at 10 kHz it keeps the largest margin.");
  spec.remark(
      "The command is computed from the error of the same instant and held until the next: there is no "
      "hidden computation delay.");
  spec.input(&In<double>::u, "u", "$a", "control error");
  spec.state(&State<double>::integral, "integral", "$b", "integral part");
  spec.state(&State<double>::rate, "rate", "$a/s", "filtered rate of the error");
  spec.state(&State<double>::error, "error", "$a", "last error");
  spec.output(&Out<double>::y, "y", "$b", "command");
  spec.param(&Params<double>::kp, "kp", "$b/$a", "proportional gain, e.g. \"1.207 V/um\"");
  spec.param(&Params<double>::ki, "ki", "$b/$a/s", "integral gain, e.g. \"7009 V/(um s)\"").optional("0");
  spec.param(&Params<double>::kd, "kd", "$b*s/$a", "derivative gain").optional("0");
  spec.param(&Params<double>::filter, "filter", "s", "time constant of the derivative filter")
      .optional("0 s")
      .not_negative();
  spec.param(&Params<double>::lower, "lower", "$b", "lower limit of the command");
  spec.param(&Params<double>::upper, "upper", "$b", "upper limit of the command");
  spec.text("rule", {"forward", "backward", "trapezoidal"},
            "integration rule: forward Euler, backward Euler or trapezoidal");
  spec.text("anti_windup", {"none", "clamping", "back_calculation"},
            "anti-windup method: how the integral reacts while a limit is active");
  spec.param(&Params<double>::tracking_time, "tracking_time", "s",
             "back_calculation: tracking time constant; 0 = kp/ki, at least one period")
      .optional("0 s")
      .not_negative();
  spec.param(&Params<double>::initial, "initial", "$b", "initial value of the integral part")
      .optional("0")
      .difference();
  spec.sampled(&Params<double>::period, &Params<double>::offset);
}

std::string SampledPid::check(const Params<double>& p) {
  if (p.lower < p.upper) return "";
  return "lower, {lower}, is not below upper, {upper}; exchange them";
}

Kernel sampled_pid_block() { return kernel<SampledPid>(); }

}  // namespace hysteron::blocks
