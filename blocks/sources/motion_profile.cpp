#include "blocks/sources/motion_profile.h"

#include "models/sources/signals.h"

namespace hysteron::blocks {

void MotionProfile::describe(Declaration& d) {
  d.name("motion_profile", "point-to-point motion with limited velocity, acceleration and jerk").in_group("sources");
  d.law(
       "each move goes from rest to rest in the shortest time with |velocity|, |acceleration| and |jerk| "
       "within their limits: seven segments with the jerk +, 0, -, 0, -, 0, + times its limit; short moves "
       "do not reach all limits")
      .from("Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots (2008), section 3.4");
  d.remark("Velocity and acceleration are outputs for feedforward control.");
  d.remark(
      "\"profile\": \"trapezoid\" has no jerk limit: the velocity is trapezoidal and the acceleration "
      "jumps; leave jerk out then.");
  d.output("position", "$a", "reference position");
  d.output("velocity", "$a/s", "reference velocity");
  d.output("acceleration", "$a/s^2", "reference acceleration");
  d.list("positions", "$a", "target positions, in order");
  d.parameter("velocity", "$a/s", "largest speed").positive().difference();
  d.parameter("acceleration", "$a/s^2", "largest acceleration").positive().difference();
  d.parameter("jerk", "$a/s^3", "largest jerk; only for the profile s_curve").optional("0").not_negative().difference();
  d.text("profile", {"s_curve", "trapezoid"}, "s_curve: limited jerk; trapezoid: unlimited jerk");
  d.parameter("dwell", "s", "rest time after each move").optional("0 s").not_negative();
  d.parameter("time", "s", "start of the first move").optional("0 s");
  d.parameter("initial", "$a", "initial position").optional("0");
}

Sizes MotionProfile::sizes(const Shape& shape) {
  Sizes s;
  s.outputs = 3;
  s.feedthrough = false;
  const bool sharp = shape.text("profile") == "trapezoid";
  s.smoothness = sharp ? Smoothness::jumps : Smoothness::smooth;
  if (shape.length("positions") < 1) s.error = "\"positions\" is empty; give at least one position";
  return s;
}

std::string MotionProfile::check(const View<double>& v) {
  if (v.choice(profile) == 0 && !(v.parameter(jerk) > 0))
    return "an S-curve needs its \"jerk\"; write e.g. \"jerk\": \"100 m/s^3\", or \"profile\": \"trapezoid\"";
  return "";
}

double MotionProfile::next_breakpoint(const View<double>& v) {
  const auto leg = leg_at(v, v.t);
  for (const double corner : leg.move.meeting())
    if (const double at = leg.begin + corner; at > v.t) return at;
  return leg.is_last ? signals::never
                     : signals::strictly_behind(v.t, leg.begin + leg.move.duration() + v.parameter(dwell));
}

Kernel motion_profile_block() { return kernel<MotionProfile>(); }

}  // namespace hysteron::blocks
