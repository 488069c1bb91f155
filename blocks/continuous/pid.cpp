#include "blocks/continuous/pid.h"

#include <fmt/format.h>

#include <cmath>

namespace hysteron::blocks {

void describe_pid_ports(Declaration& d, bool tracks) {
  d.input("reference", "$a", "where it should be; the error, where measured is a constant 0");
  d.input("measured", "$a", "where it is");
  if (tracks) d.input("tracked", "$b", "what the actuator really does, or what commands it while this one does not");
  d.output("y", "$b", "command");
}

void describe_pid(Declaration& d) {
  d.controller();
  d.text("form", {"parallel", "standard", "series"}, "what the gains mean");
  d.parameter("kp", "$b/$a", "proportional gain; of standard and series that of all, e.g. \"1.2 V/um\"");
  d.parameter("ki", "$b/$a/s", "parallel: integral gain, e.g. \"7009 V/(um s)\"").optional("0");
  d.parameter("kd", "$b*s/$a", "parallel: derivative gain").optional("0");
  d.parameter("integral_time", "s", "standard and series: of the integral; 0 = none").optional("0 s").not_negative();
  d.parameter("derivative_time", "s", "standard and series: of the derivative; 0 = none")
      .optional("0 s")
      .not_negative();
  d.parameter("filter", "s", "time constant of the derivative's filter; 0 = a tenth of kd/kp or derivative_time")
      .optional("0 s")
      .not_negative();
  d.text("derivative_on", {"measured", "error"},
         "what the derivative is one of; a jump of the reference is no kick of the first");
  d.parameter("setpoint_weight", "", "of the reference in the proportional part").optional("1");
  d.parameter("lower", "$b", "smallest command").optional("-inf");
  d.parameter("upper", "$b", "largest command").optional("inf");
  d.parameter("rate", "$b/s", "largest rate of the command; 0 = no limit").optional("0").not_negative().difference();
}

void describe_windup(Declaration& d, bool tracks) {
  d.text("anti_windup", {"back_calculation", "clamping", "none"},
         tracks ? "what a command that is not followed does to the integral" : "what a limit does to the integral");
  d.parameter("tracking_time", "s", "back_calculation: time in which the integral follows; 0 = that of the integral")
      .optional("0 s")
      .not_negative();
  d.parameter("initial", "$b", "integral part at the start").optional("0").difference();
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
    return "without kp nothing says how fast the derivative's filter is; give \"filter\", e.g. \"1 ms\"";
  const bool is_limited = !std::isinf(p.lower) || !std::isinf(p.upper) || p.rate > 0;
  if (windup == pid::AntiWindup::back_calculation && is_limited && p.ki != 0 && p.kp == 0 && !(tracking_time > 0))
    return "without kp nothing says how fast the integral follows the limited command; give \"tracking_time\", e.g. "
           "\"10 ms\"";
  return "";
}

template <bool tracks>
void Pid<tracks>::describe(Declaration& d) {
  if (tracks)
    d.name("pid_tracking", "PID controller whose integral follows what the actuator really does, continuous");
  else
    d.name("pid", "PID controller with limits and anti-windup, continuous");
  d.in_group("continuous").elementwise();
  d.law(
       "y = sat(kp (setpoint_weight r - m) + I + kd d), dI/dt = ki (r - m) + windup, d = s/(filter s + 1) of -m or r - "
       "m; standard: ki = kp/integral_time, kd = kp derivative_time; series: P and I see r - m + derivative_time d; "
       "back_calculation: windup = (y - what y would be without limits)/tracking_time; clamping: no integral that pushes "
       "further beyond a limit")
      .from("Astrom, Hagglund, Advanced PID Control (2006), chapter 3");
  d.remark("An error that is there already is \"reference\", with a constant 0 as \"measured\".");
  d.remark(
      "\"output_rate\": \"limited\" makes the command a state that follows within follow_time, at most with rate.");
  d.remark(
      tracks
          ? "With back_calculation I follows tracked, and not its own limits: while another controller commands, wire "
            "that one's command to it, and the change between both is bumpless."
          : "The integral follows its own limits; limits of an actuator behind it: \"pid_tracking\".");
  d.remark("At a microcontroller's instants: \"discrete_pid\".");
  describe_pid_ports(d, tracks);
  d.state("integral", "$b", "integral part");
  d.state("filtered", "$a", "what is differentiated, filtered");
  describe_pid(d);
  d.text("output_rate", {"free", "limited"}, "whether the command keeps to \"rate\"");
  d.parameter("follow_time", "s", "limited: time constant with which the command follows").optional("1 ms").positive();
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
