#include "blocks/sampled/discrete_pid.h"

namespace hysteron::blocks {

template <bool tracks>
void DiscretePid<tracks>::describe(BlockSpec<DiscretePid>& spec) {
  if (tracks)
    spec.name("discrete_pid_tracking", "digital PID controller whose integral follows what the actuator really does");
  else
    spec.name("discrete_pid", "digital PID controller of reference and measured value, with limits and anti-windup");
  spec.in_group("sampled").elementwise();
  spec.law(
          "y = sat(kp (setpoint_weight r - m) + I + kd d), d_k = (filter d_(k-1) + s_k - s_(k-1))/(filter + T) of s = "
          "-m or e = r - m; forward: I_(k+1) = I_k + ki T e_k; backward: with e_k at once; trapezoidal: with (e_k + "
          "e_(k-1))/2 at once; standard: ki = kp/integral_time, kd = kp derivative_time; series: P and I see r - m + "
          "derivative_time d; back_calculation: I_(k+1) += T/tracking_time (y - what y would be without limits); "
          "clamping: an increment that pushes further beyond a limit is left out")
      .from("Astrom, Hagglund, Advanced PID Control (2006), sections 3.5 and 13.4");
  spec.remark("An error that is there already is \"reference\", with a constant 0 as \"measured\".");
  spec.remark("At its first instant the past counts as the present: the derivative does not kick.");
  spec.remark("The command is computed from the values at the same instant and held until the next: no hidden delay.");
  spec.remark(
      tracks
          ? "With back_calculation I follows tracked, and not its own limits: while another controller commands, wire "
            "that one's command to it, and the change between both is bumpless."
          : "The integral follows its own limits; limits of an actuator behind it: \"discrete_pid_tracking\".");
  describe_pid_ports(spec, tracks);
  spec.Declaration::state("integral", "$b", "integral part");
  spec.Declaration::state("rate", "$a/s", "filtered rate of what is differentiated");
  spec.Declaration::state("differentiated", "$a", "its last value");
  spec.Declaration::state("error", "$a", "last error");
  spec.Declaration::state("command", "$b", "last command");
  spec.Declaration::state("begun", "", "1 behind the first instant");
  describe_pid(spec);
  spec.text("rule", {"forward", "backward", "trapezoidal"}, "how the error is summed");
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
