#include "blocks/sources/motion_profile.h"

#include "models/sources/signals.h"

namespace hysteron::blocks {

void MotionProfile::describe(Declaration& d) {
  d.name("motion_profile", "moves from place to place within limits of velocity, acceleration and jerk")
      .in_group("sources");
  d.law(
       "each move takes the shortest time in which |velocity|, |acceleration| and |jerk| stay within their limits, from "
       "rest to rest: seven pieces, jerk +, 0, -, 0, -, 0, + of the limit; short moves reach fewer limits")
      .from("Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots (2008), section 3.4");
  d.remark("Velocity and acceleration are outputs, for feed-forward.");
  d.remark(
      "\"profile\": \"trapezoid\" has no limit of jerk: the velocity is a trapezoid and the acceleration jumps; leave "
      "jerk out then.");
  d.output("position", "$a", "where it should be");
  d.output("velocity", "$a/s", "its rate");
  d.output("acceleration", "$a/s^2", "the rate of that");
  d.list("positions", "$a", "where the moves lead, one behind the other");
  d.parameter("velocity", "$a/s", "largest speed").positive().difference();
  d.parameter("acceleration", "$a/s^2", "largest acceleration").positive().difference();
  d.parameter("jerk", "$a/s^3", "largest rate of the acceleration").optional("0").not_negative().difference();
  d.text("profile", {"s_curve", "trapezoid"}, "whether the jerk is limited");
  d.parameter("dwell", "s", "how long it rests behind each move").optional("0 s").not_negative();
  d.parameter("time", "s", "begin of the first move").optional("0 s");
  d.parameter("initial", "$a", "where it is before").optional("0");
}

Sizes MotionProfile::sizes(const Shape& shape) {
  Sizes s;
  s.outputs = 3;
  s.feedthrough = false;
  const bool sharp = shape.text("profile") == "trapezoid";
  s.smoothness = sharp ? Smoothness::jumps : Smoothness::smooth;
  if (shape.length("positions") < 1) s.error = "\"positions\" is empty; give at least one place";
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
