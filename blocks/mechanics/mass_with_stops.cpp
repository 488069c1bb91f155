#include "blocks/mechanics/mass_with_stops.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void MassWithStops::describe(BlockSpec<MassWithStops>& spec) {
  spec.name("mass_with_stops", "mass between two hard stops, driven by a force");
  spec.law(
          "free: mass dv/dt = force - damping v - stiffness x; at lower or upper: v after = -restitution v "
          "before; the mass rests at the stop while the force presses it there")
      .from("Newton's law of restitution; Brogliato, Nonsmooth Mechanics, 3rd ed. (2016)");
  spec.remark(
      "The instants of impact are located. A rebound not faster than rest_speed is set to zero, which ends "
      "a series of decreasing rebounds.");
  spec.remark("With stops out of reach the block equals mass_spring_damper.");
  describe_motion(spec).optional("0");
  spec.param(&Params<double>::lower, "lower", "m", "position of the lower stop");
  spec.param(&Params<double>::upper, "upper", "m", "position of the upper stop");
  spec.param(&Params<double>::restitution, "restitution", "",
             "coefficient of restitution: speed after over speed before an impact")
      .optional("0")
      .not_negative()
      .maximum = 1;
  spec.param(&Params<double>::rest_speed, "rest_speed", "m/s", "speed below which a rebound is set to zero")
      .optional("1 um/s")
      .positive();
  describe_start(spec);
}

std::string MassWithStops::check(const Params<double>& p) {
  if (!(p.lower < p.upper))
    return fmt::format("lower ({:.4g} m) is not below upper ({:.4g} m); exchange them", p.lower, p.upper);
  if (p.initial_position < p.lower || p.initial_position > p.upper)
    return fmt::format("the start at {:.4g} m is not between the stops; give initial_position from {:.4g} to {:.4g} m",
                       p.initial_position, p.lower, p.upper);
  return "";
}

Kernel mass_with_stops_block() { return kernel<MassWithStops>(); }

}  // namespace hysteron::blocks
