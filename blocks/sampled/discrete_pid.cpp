#include "blocks/sampled/discrete_pid.h"

namespace hysteron::blocks {

template <bool tracks>
void DiscretePid<tracks>::describe(BlockSpec<DiscretePid>& spec) {
  if (tracks)
    spec.name("discrete_pid_tracking", "digital PID controller with anti-windup from the actuator output");
  else
    spec.name("discrete_pid", "digital PID controller with limits and anti-windup");
  spec.in_group("sampled").elementwise();
  spec.law(
          "y = sat(kp (setpoint_weight r - m) + I + kd d), d_k = (filter d_(k-1) + s_k - s_(k-1))/(filter + T) "
          "of s = -m or e = r - m; forward: I_(k+1) = I_k + ki T e_k; backward: with e_k at once; trapezoidal: "
          "with (e_k + e_(k-1))/2 at once; standard: ki = kp/integral_time, kd = kp derivative_time; series: P "
          "and I act on r - m + derivative_time d; back_calculation: I_(k+1) += T/tracking_time (y - y without "
          "limits); clamping: an increment that would drive y further beyond a limit is left out")
      .from("Astrom, Hagglund, Advanced PID Control (2006), sections 3.5 and 13.4");
  spec.remark(
      "If the control error is already available, wire it to \"reference\" and a \"constant\" 0 to "
      "\"measured\".");
  spec.remark(
      "At the first instant the past values are taken equal to the present ones: there is no derivative "
      "kick.");
  spec.remark(
      "The command is computed from the values of the same instant and held until the next: there is no "
      "hidden computation delay.");
  spec.remark(
      tracks ? "With back_calculation the integral tracks the input \"tracked\" in place of the block's own limits. "
               "For bumpless transfer wire the command of the active controller to it."
             : "Anti-windup uses the limits of this block only; for limits of an actuator after it use "
               "\"discrete_pid_tracking\".");
  describe_pid_ports(spec, tracks);
  spec.Declaration::state("integral", "$b", "integral part");
  spec.Declaration::state("rate", "$a/s", "filtered rate of what is differentiated");
  spec.Declaration::state("differentiated", "$a", "last value of the differentiated signal");
  spec.Declaration::state("error", "$a", "last error");
  spec.Declaration::state("command", "$b", "last command");
  spec.Declaration::state("begun", "", "1 after the first instant");
  describe_pid(spec);
  spec.text("rule", {"forward", "backward", "trapezoidal"},
            "integration rule: forward Euler, backward Euler or trapezoidal");
  describe_windup(spec, tracks);
  spec.sampled(&Params<double>::period, &Params<double>::offset);
}

template <bool tracks>
std::string DiscretePid<tracks>::check(const Params<double>& p) {
  return check_pid({p.form, p.kp, p.ki, p.kd, p.integral_time, p.derivative_time, p.filter, p.derivative_on,
                    p.setpoint_weight, p.lower, p.upper, p.rate},
                   pid::AntiWindup::none,
                   p.tracking_time);  // where nothing else says, the integral follows in a period
}

Kernel discrete_pid_block() { return kernel<DiscretePid<false>>(); }
Kernel discrete_pid_tracking_block() { return kernel<DiscretePid<true>>(); }

}  // namespace hysteron::blocks
