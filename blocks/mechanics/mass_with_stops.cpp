#include "blocks/mechanics/mass_with_stops.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void MassWithStops::describe(BlockSpec<MassWithStops>& spec) {
  spec.name("mass_with_stops", "one mass between two hard stops, driven by a force");
  spec.law(
          "free: mass dv/dt = force - damping v - stiffness x; at lower or upper: v after = -restitution v before; it "
          "lies "
          "at the stop while the force presses")
      .from("Newton's law of restitution; Brogliato, Nonsmooth Mechanics, 3rd ed. (2016)");
  spec.remark("Impacts are located. A rebound not above rest_speed is none: it ends the series of ever smaller ones.");
  spec.remark("Stops out of reach give mass_spring_damper.");
  describe_motion(spec).optional("0");
  spec.param(&Params<double>::lower, "lower", "m", "lower stop");
  spec.param(&Params<double>::upper, "upper", "m", "upper stop");
  spec.param(&Params<double>::restitution, "restitution", "", "speed after over speed before an impact")
      .optional("0")
      .not_negative()
      .maximum = 1;
  spec.param(&Params<double>::rest_speed, "rest_speed", "m/s", "a slower rebound is none")
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
