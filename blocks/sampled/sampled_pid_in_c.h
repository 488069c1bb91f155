// Decides what the blocks of sampled PID controllers have in common in C: models/sampled/sampled_pid.h behind the rate
// of the derivative, operation by operation.
#pragma once

#include <string>

#include "models/sampled/sampled_pid.h"

namespace hysteron::blocks::sampled_pid_in_c {

/// From `error` and `proportional` (C expressions) to the command and the integral behind it. `limit_rate`: statements
/// between the wanted command `raw` and the `command` within the limits; `given`: what the actuator does.
inline std::string command(sampled_pid::Rule rule, sampled_pid::AntiWindup windup, bool has_integral,
                           const std::string& error, const std::string& proportional, const std::string& derivative,
                           const std::string& near, const std::string& given) {
  using sampled_pid::AntiWindup;
  using sampled_pid::Rule;
  std::string c = "const double increment = ";
  c += rule == Rule::trapezoidal ? "0.5 * $t.ki[0] * $p.period * (" + error + " + " + "before);\n"
                                 : "$t.ki[0] * $p.period * " + error + ";\n";
  c += std::string("const double integral = $s.integral") + (rule == Rule::forward ? "" : " + increment") + ";\n";
  c += "const double raw = " + proportional + " + integral" + derivative + ";\n";
  c += "$out.y = larger($p.lower, smaller($p.upper, " + near + "));\n";
  if (windup == AntiWindup::clamping)
    return c +
           "if (!((raw > $out.y && increment > 0.0) || (raw < $out.y && increment < 0.0)))\n"
           "    $s.integral = $s.integral + increment;\n";
  c += "$s.integral = $s.integral + increment;\n";
  if (windup == AntiWindup::back_calculation && has_integral)
    c += "$s.integral += $p.period / $t.tracking_time[0] * (" + given + " - raw);\n";
  return c;
}

}  // namespace hysteron::blocks::sampled_pid_in_c
