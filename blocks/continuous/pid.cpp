#include "blocks/continuous/pid.h"

#include <fmt/format.h>

#include <cmath>

namespace hysteron::blocks {

void describe_pid_ports(Declaration& d, bool tracks) {
  d.input("reference", "$a", "reference (setpoint); or the control error, if measured is a constant 0");
  d.input("measured", "$a", "measured value");
  if (tracks)
    d.input("tracked", "$b", "actual output of the actuator, or the command of the controller that is active instead");
  d.output("y", "$b", "command");
}

void describe_pid(Declaration& d) {
  d.controller();
  d.text("form", {"parallel", "standard", "series"}, "form of the control law, which sets the meaning of the gains");
  d.parameter("kp", "$b/$a",
              "proportional gain, e.g. \"1.2 V/um\"; in standard and series form it multiplies all parts");
  d.parameter("ki", "$b/$a/s", "parallel: integral gain, e.g. \"7009 V/(um s)\"").optional("0");
  d.parameter("kd", "$b*s/$a", "parallel: derivative gain").optional("0");
  d.parameter("integral_time", "s", "standard and series: integral time; 0 = no integral part")
      .optional("0 s")
      .not_negative();
  d.parameter("derivative_time", "s", "standard and series: derivative time; 0 = no derivative part")
      .optional("0 s")
      .not_negative();
  d.parameter("filter", "s", "time constant of the derivative filter; 0 = a tenth of kd/kp or of derivative_time")
      .optional("0 s")
      .not_negative();
  d.text("derivative_on", {"measured", "error"},
         "signal that is differentiated; with \"measured\" a step of the reference gives no derivative kick");
  d.parameter("setpoint_weight", "", "weight of the reference in the proportional part").optional("1");
  d.parameter("lower", "$b", "lower limit of the command").optional("-inf");
  d.parameter("upper", "$b", "upper limit of the command").optional("inf");
  d.parameter("rate", "$b/s", "largest rate of change of the command; 0 = no limit")
      .optional("0")
      .not_negative()
      .difference();
}

void describe_windup(Declaration& d, bool tracks) {
  d.text("anti_windup", {"back_calculation", "clamping", "none"},
         tracks ? "how the integral reacts while the actuator does not follow the command"
                : "anti-windup method: how the integral reacts while a limit is active");
  d.parameter("tracking_time", "s", "back_calculation: tracking time constant; 0 = the integral time")
      .optional("0 s")
      .not_negative();
  d.parameter("initial", "$b", "initial value of the integral part").optional("0").difference();
}

std::string check_pid(const PidNumbers& p, pid::AntiWindup windup, double tracking_time) {
  const bool parallel = pid::Form(static_cast<int>(p.form)) == pid::Form::parallel;
  if (parallel && (p.integral_time > 0 || p.derivative_time > 0))
    return "integral_time and derivative_time belong to the forms standard and series; write \"ki\" and \"kd\", or "
           "\"form\": \"standard\"";
  if (!parallel && (p.ki != 0 || p.kd != 0))
    return "ki and kd belong to the form parallel; write \"integral_time\" and \"derivative_time\", or \"form\": "
           "\"parallel\"";
  if (!(p.lower < p.upper)) return "lower, {lower}, is not below upper, {upper}; exchange them";
  if (p.kd != 0 && p.kp == 0 && !(p.filter > 0))
    return "without kp there is no default for the derivative filter; give \"filter\", e.g. \"1 ms\"";
  const bool is_limited = !std::isinf(p.lower) || !std::isinf(p.upper) || p.rate > 0;
  if (windup == pid::AntiWindup::back_calculation && is_limited && p.ki != 0 && p.kp == 0 && !(tracking_time > 0))
    return "without kp there is no default for the tracking time; give \"tracking_time\", e.g. \"10 ms\"";
  return "";
}

template <bool tracks>
void Pid<tracks>::describe(Declaration& d) {
  if (tracks)
    d.name("pid_tracking", "PID controller with anti-windup from the actuator output");
  else
    d.name("pid", "PID controller with limits and anti-windup, continuous");
  d.in_group("continuous").elementwise();
  d.law(
       "y = sat(kp (setpoint_weight r - m) + I + kd d), dI/dt = ki (r - m) + windup, d = s/(filter s + 1) "
       "of -m or r - m; standard: ki = kp/integral_time, kd = kp derivative_time; series: P and I act on r "
       "- m + derivative_time d; back_calculation: windup = (y - y without limits)/tracking_time; clamping: "
       "dI/dt = 0 while it would drive y further beyond a limit")
      .from("Astrom, Hagglund, Advanced PID Control (2006), chapter 3");
  d.remark(
      "If the control error is already available, wire it to \"reference\" and a \"constant\" 0 to "
      "\"measured\".");
  d.remark(
      "\"output_rate\": \"limited\" makes the command a state that follows the control law with the time "
      "constant follow_time, no faster than \"rate\".");
  d.remark(tracks
               ? "With back_calculation the integral tracks the input \"tracked\" in place of the block's own limits. "
                 "For bumpless transfer wire the command of the active controller to it."
               : "Anti-windup uses the limits of this block only; for limits of an actuator after it use "
                 "\"pid_tracking\".");
  d.remark("For a sampled controller use \"discrete_pid\".");
  describe_pid_ports(d, tracks);
  d.state("integral", "$b", "integral part");
  d.state("filtered", "$a", "filtered input of the derivative part");
  describe_pid(d);
  d.text("output_rate", {"free", "limited"}, "whether \"rate\" limits the command");
  d.parameter("follow_time", "s", "limited: time constant with which the command follows the control law")
      .optional("1 ms")
      .positive();
  describe_windup(d, tracks);
}

template <bool tracks>
Sizes Pid<tracks>::sizes(const Shape& shape) {
  Sizes s;
  const bool follows = shape.text("output_rate") == "limited";
  s.states = follows ? 3 : 2;
  s.feedthrough = !follows;
  s.kinks = 2 + (shape.text("anti_windup") == "clamping" ? 3 : 0) + (follows ? 2 : 0);
  return s;
}

template <bool tracks>
std::string Pid<tracks>::check(const View<double>& v) {
  const auto p = [&](int i) { return v.parameter(i); };
  if (has_command(v) != (p(rate) > 0))
    return has_command(v) ? "\"output_rate\" is limited, but \"rate\" is 0; give it, e.g. \"rate\": \"100 V/s\""
                          : "\"rate\" limits nothing while \"output_rate\" is free; write \"output_rate\": \"limited\"";
  const auto windup = pid::AntiWindup(v.choice(anti_windup));
  if (windup == pid::AntiWindup::clamping && (std::isinf(p(lower)) || std::isinf(p(upper))))
    return "clamping needs both limits; give \"lower\" and \"upper\", or take back_calculation";
  return check_pid({p(form), p(kp), p(ki), p(kd), p(integral_time), p(derivative_time), p(filter), p(derivative_on),
                    p(setpoint_weight), p(lower), p(upper), p(rate)},
                   windup, p(tracking_time));
}

Kernel pid_block() { return kernel<Pid<false>>(); }
Kernel pid_tracking_block() { return kernel<Pid<true>>(); }

}  // namespace hysteron::blocks
