#include "discover/effects/presliding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/hypotheses/effect_terms.h"
#include "discover/hypotheses/travel.h"

namespace hysteron::effects {
namespace {

/// Largest speed of a motion over `range`, if that is as quick as what drives it; at most the whole range in a row.
double largest_speed(double range, const Excitation& at) {
  const double row_rate = 1 / std::max(at.shortest_step, 1e-9);  // [1/s]
  return range * (at.quickest > 0 ? std::min(at.quickest, row_rate) : row_rate);
}

/// Holds more before it slides fast. `fast`: the largest speed, in speed_unit's SI. An excess at no speed at all is
/// none, and looks best to begin with: a search from there ends at an excess without bound that nothing shows.
Law with_excess(Law law, double fast, const Unit& speed_unit) {
  give(law.block, "excess", 0.0);
  LawParameter excess;
  excess.path = "excess";
  excess.lower = 0;
  excess.upper = 3;
  excess.scan = {0.2};
  excess.plausible_upper = 1;  // breakaway over Coulomb friction: 1 .. 2
  give(law.block, "stribeck_velocity", with_unit(0.02 * fast, speed_unit));
  LawParameter speed;
  speed.path = "stribeck_velocity";
  speed.start = 0.02 * fast;
  speed.lower = 1e-4 * fast;
  speed.upper = 10 * fast;
  speed.log_scale = true;
  // Guides lose their excess within a small part of the speeds of a swing (0.1 .. 10 mm/s: Armstrong-Helouvry 1994).
  speed.scan = {2e-3 * fast, 0.02 * fast, 0.2 * fast};
  law.free.push_back(excess);
  law.free.push_back(speed);
  return law;
}

}  // namespace

bool is_motion(const Unit& unit) {
  return unit.dimension == parse_unit("m").dimension || unit.dimension == parse_unit("rad").dimension;
}

bool is_speed(const Unit& unit) {
  return unit.dimension == parse_unit("m/s").dimension || unit.dimension == parse_unit("rad/s").dimension;
}

namespace {

constexpr const char *of_a_mass = "mass_with_friction", *of_an_inertia = "inertia_with_friction",
                     *of_a_speed = "integrator_with_friction";

std::string dry_type(const Excitation& at) {
  if (makes_a_speed(at)) return at.by;
  return at.by == "mass_with_presliding" ? of_a_mass : at.by == "inertia_with_presliding" ? of_an_inertia : "";
}

}  // namespace

bool can_be_dry(const Excitation& at) { return !dry_type(at).empty(); }
bool is_dry(const Law& law) {
  return law.block.type == of_a_mass || law.block.type == of_an_inertia || law.block.type == of_a_speed;
}

Law dry(const Excitation& at) {
  Law law;
  law.name = "dry (Coulomb)";
  law.apart = true;
  law.block.type = dry_type(at);
  const double force = driving_range(at) > 0 ? driving_range(at) : 1;
  LawParameter level;
  level.path = makes_a_speed(at) ? "level" : "coulomb";
  level.is_size = true;
  level.start = 0.05 * force;
  level.lower = 0;  // it takes energy
  level.upper = force;
  // As far apart as a search finds from one to the next; below a hundredth of what drives it little is seen.
  for (const double share : {0.003, 0.01, 0.03, 0.1, 0.3}) level.scan.push_back(share * force);
  // What is left of a drive whose motion takes its force away (a back-EMF, a damping) is large where it jumps only.
  if (makes_a_speed(at)) level.scan.insert(level.scan.begin(), {0.0003 * force, 0.001 * force});
  give(law.block, level.path,
       with_unit(level.start, makes_a_speed(at) ? at.unit : parse_unit(turns(at) ? "N m" : "N")));
  law.free = {level};
  return law;
}

Law dry_with_excess(const Excitation& at) {
  const double fast = makes_a_speed(at) ? std::max(std::abs(at.travel_lowest), std::abs(at.travel_highest))
                                        : largest_speed(travel(at), at);
  Law law = with_excess(dry(at), fast > 0 ? fast : travel(at), parse_unit(turns(at) ? "rad/s" : "m/s"));
  law.apart = false;
  law.name = "dry with Stribeck's excess";
  return law;
}

Law dry_with_quick_excess(const Excitation& at) {
  Law law = dry_with_excess(at);
  law.name = "dry with an excess that falls as an exponential (Tustin)";
  give(law.block, "stribeck_exponent", 1.0);
  return law;
}

Law presliding(const Excitation& at) {
  Law law;
  law.name = "presliding (Dahl)";
  law.block.type = at.by.empty() ? "mass_with_presliding" : at.by;
  const double range = travel(at), force = driving_range(at) > 0 ? driving_range(at) : 1;
  give(law.block, "contact_stiffness",
       NumberList{with_unit(0.5 * force / range, parse_unit(turns(at) ? "N*m/rad" : "N/m"))});
  give(law.block, "slip_distance", NumberList{with_unit(0.02 * range, parse_unit(turns(at) ? "mrad" : "um"))});
  LawParameter k;
  k.path = element("contact_stiffness", 0);
  k.is_size = true;
  k.start = 0.5 * force / range;
  k.lower = 1e-5 * force / range;
  k.upper = 1e4 * force / range;
  k.log_scale = true;
  // Forces of 1, 5, 25 % of the largest after ways of 0.01, 0.1, 1 % of the stroke, and what lies between: from a start
  // that holds far more, or slides far later, a search ends where it is worse than without it.
  for (const double f : {1.0, 5.0, 25.0, 125.0, 625.0, 2500.0}) k.scan.push_back(f * force / range);
  LawParameter d;
  d.path = element("slip_distance", 0);
  d.start = 0.02 * range;
  d.lower = 1e-4 * range;
  d.upper = 10 * range;
  d.log_scale = true;
  for (const double f : {1e-4, 1e-3, 1e-2}) d.scan.push_back(f * range);
  if (!turns(at)) d.plausible_upper = 50e-6;  // [m]; what an angle is at a contact hangs on its radius
  law.free = {k, d};
  return law;
}

Law presliding_with_excess(const Excitation& at) {
  Law law = with_excess(presliding(at), largest_speed(travel(at), at), parse_unit(turns(at) ? "rad/s" : "m/s"));
  law.name = "presliding with Stribeck's excess (LuGre)";
  return law;
}

Law guided(const Excitation& at) {
  Law law;
  law.name = "holds the motion back (Dahl)";
  law.block.type = "guide_friction";
  const double range = at.range() > 0 ? at.range() : 1;
  LawParameter level;
  level.path = "level";
  level.is_size = true;
  level.start = 0.01 * range;
  level.lower = 0;                  // it takes energy
  level.upper = short_way * range;  // see the slip distance: it slides once the pull is above this
  level.scan = {0.001 * range, 0.01 * range};
  give(law.block, "level", with_unit(level.start, at.unit));
  LawParameter slip;
  slip.path = "slip_distance";
  slip.start = 0.03 * range;
  // A guide slides within a tenth of the stroke; what bends over all of it is the actuator's own hysteresis.
  slip.upper = short_way * range;
  slip.lower = 1e-7 * range;
  slip.log_scale = true;
  slip.scan = per_decade(1e-3 * range, short_way * range, 2);
  give(law.block, "slip_distance", with_unit(slip.start, at.unit));
  law.free = {level, slip};
  return law;
}

Law guided_with_excess(const Excitation& at) {
  const double range = at.range() > 0 ? at.range() : 1;
  Law law = with_excess(guided(at), largest_speed(range, at), parse_unit(fmt::format("({})/s", unit_text(at.unit))));
  law.name = "holds the motion back, with Stribeck's excess (LuGre)";
  return law;
}

double fastest(const Excitation& at) { return std::max({std::abs(at.lowest), std::abs(at.highest), 1e-30}); }

LawParameter give_slip_distance(Law& law, const Excitation& at) {
  const double way = fastest(at) * at.shortest_step;
  LawParameter slip;
  slip.path = "slip_distance";
  slip.start = way;
  slip.lower = 1e-3 * way;
  slip.upper = 1e3 * way;
  slip.log_scale = true;
  slip.scan = per_decade(0.03 * way, 10 * way, 2);
  give(law.block, "slip_distance", with_unit(slip.start, parse_unit(fmt::format("({})*s", unit_text(at.unit)))));
  return slip;
}

Law beside_damping(const Excitation& at) {
  Law law;
  law.name = "sticks and slides beside the damping (Dahl)";
  law.block.type = "bearing_friction";
  const double fast = fastest(at);
  LawParameter level;
  level.path = "level";
  level.is_size = true;
  level.start = 0.3 * fast;
  level.lower = 0;  // it takes energy
  // Bearings of small machines brake more by dry friction than by their damping at any speed that they reach, guides
  // that float in oil hardly.
  level.scan = {0.03 * fast, 0.3 * fast, 3 * fast};
  give(law.block, "level", with_unit(level.start, at.unit));
  LawParameter slip = give_slip_distance(law, at);
  // It stands in the loop that it brakes, which is solved in steps within a row: what slips much sooner than in a row
  // at full speed is a switch between two rows, stiff, and no row tells it from a softer one.
  slip.lower = slip.start;
  slip.scan = per_decade(slip.start, 10 * slip.start, 2);
  law.free = {level, slip};
  return law;
}

Law beside_damping_with_excess(const Excitation& at) {
  Law law = with_excess(beside_damping(at), fastest(at), at.unit);
  law.name = "sticks and slides beside the damping, with Stribeck's excess";
  return law;
}

std::string told_beside_damping(const std::vector<double>& values, const Excitation& at) {
  const bool rotates = dimension_factor(at.unit.dimension, parse_unit("rad/s").dimension) != 0;
  std::string text = fmt::format("as much as the damping at {:.3g} {}: {:.3g} {} by the gain of the diagram",
                                 at.unit.difference_from_si(values[0]), at.unit.text, values[0] * std::abs(*at.damping),
                                 rotates ? "N m" : "N");
  if (values.size() > 3)
    text += fmt::format(", {:.2g} % more below {:.3g} {}", 100 * values[2], at.unit.difference_from_si(values[3]),
                        at.unit.text);
  return text;
}

std::string told_of_a_speed(const std::vector<double>& values, const Excitation& at) {
  const char *unit = turns(at) ? "rad/s^2" : "m/s^2", *force = turns(at) ? "N m" : "N";
  std::string text = fmt::format("{:.3g} {} ({:.2g} % of the acceleration)", values[0], unit,
                                 100 * values[0] / std::max(driving_range(at), 1e-300));
  if (at.inertia) text += fmt::format(": {:.3g} {} by the gain before it", values[0] * *at.inertia, force);
  if (values.size() > 1) text += fmt::format(", {:.2g} % more before it slides fast", 100 * values[1]);
  return text;
}

}  // namespace hysteron::effects
