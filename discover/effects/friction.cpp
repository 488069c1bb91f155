// The effect friction: in the guide of a mass, on a wire that carries a speed, behind a motion without a mass.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/effects/library.h"
#include "discover/effects/travel.h"

namespace hysteron::effects {
namespace {

/// Holds more before it slides fast. `fast`: the whole travel in a row, from which speeds are tried downwards.
Law with_excess(Law law, double fast, const Unit& speed_unit) {
  give(law.block, "excess", 0.0);
  LawParameter excess;
  excess.path = "excess";
  excess.lower = 0;
  excess.upper = 3;
  excess.scan = {0.2, 0.7};
  excess.plausible_upper = 1;  // breakaway over Coulomb friction: 1 .. 2
  give(law.block, "stribeck_velocity", with_unit(1e-3 * fast, speed_unit));
  LawParameter speed;
  speed.path = "stribeck_velocity";
  speed.start = 1e-3 * fast;
  speed.lower = 1e-8 * fast;
  speed.upper = fast;
  speed.log_scale = true;
  speed.scan = {1e-5 * fast, 1e-4 * fast, 1e-3 * fast, 1e-2 * fast};
  law.free.push_back(excess);
  law.free.push_back(speed);
  return law;
}

/// The contact resists its own motion while it sticks (LuGre's s1/s0): a time, of which nobody knows more than that
/// rows must show it.
Law with_contact_time(Law law, const Circumstances& at) {
  give(law.block, "contact_time", with_unit(0.0, parse_unit("s")));
  LawParameter time;
  time.path = "contact_time";
  time.lower = 0;
  time.upper = 1e3 * at.shortest_step;
  time.scan = {0, at.shortest_step, 10 * at.shortest_step};
  law.free.push_back(time);
  return law;
}

/// On a wire that carries a speed: the dashpot behind it makes a force of it. `flows`: it yields below sliding too.
Law on_a_speed(const Circumstances& at, bool flows) {
  Law law;
  law.name = flows ? "sticks, flows and slides" : "sticks and slides (Dahl)";
  law.block.type = "sliding_friction";
  const double fast = std::max({std::abs(at.lowest), std::abs(at.highest), 1e-30});
  // The way in one row at full speed: what is much shorter is a switch between two rows.
  const double way = fast * at.shortest_step;
  const Unit distance = parse_unit(fmt::format("({})*s", unit_text(at.unit)));
  LawParameter level;
  level.path = "level";
  level.start = 0.1 * fast;
  level.lower = 0;  // it takes energy
  give(law.block, "level", with_unit(level.start, at.unit));
  LawParameter slip;
  slip.path = "slip_distance";
  slip.start = way;
  slip.lower = 1e-3 * way;
  slip.upper = 1e3 * way;
  slip.log_scale = true;
  slip.scan = per_decade(0.03 * way, 10 * way, 2);
  give(law.block, "slip_distance", with_unit(slip.start, distance));
  law.free = {level, slip};
  if (!flows) return law;
  LawParameter crossover;
  crossover.path = "crossover";
  crossover.start = 0.1 * fast;
  crossover.lower = 1e-5 * fast;
  crossover.upper = fast;
  crossover.log_scale = true;
  crossover.scan = {0.003 * fast, 0.03 * fast, 0.3 * fast};
  give(law.block, "crossover", with_unit(crossover.start, at.unit));
  law.free.push_back(crossover);
  return law;
}

/// In the guide of something that moves without a mass of its own: what the guide holds back is missing from the
/// motion. `sticky`: it holds more before it slides fast.
Law on_a_motion(const Circumstances& at, bool sticky) {
  Law law;
  law.name = sticky ? "holds the motion back, with Stribeck's excess (LuGre)" : "holds the motion back (Dahl)";
  law.block.type = "guide_friction";
  const double range = at.range() > 0 ? at.range() : 1;
  LawParameter level;
  level.path = "level";
  level.start = 0.01 * range;
  level.lower = 0;                  // it takes energy
  level.upper = short_way * range;  // see the slip distance: it slides once the pull is above this
  level.scan = {0.001 * range, 0.01 * range};
  give(law.block, "level", with_unit(level.start, at.unit));
  LawParameter slip;
  slip.path = "slip_distance";
  slip.start = 0.03 * range;
  // A guide slides within a third of the stroke; what bends over all of it is the actuator's own hysteresis.
  slip.upper = short_way * range;
  slip.lower = 1e-7 * range;
  slip.log_scale = true;
  slip.scan = per_decade(1e-3 * range, short_way * range, 2);
  give(law.block, "slip_distance", with_unit(slip.start, at.unit));
  law.free = {level, slip};
  return sticky ? with_excess(law, range / std::max(at.shortest_step, 1e-9),
                              parse_unit(fmt::format("({})/s", unit_text(at.unit))))
                : law;
}

bool is_motion(const Unit& unit) {
  return unit.dimension == parse_unit("m").dimension || unit.dimension == parse_unit("rad").dimension;
}

bool is_speed(const Unit& unit) {
  return unit.dimension == parse_unit("m/s").dimension || unit.dimension == parse_unit("rad/s").dimension;
}

}  // namespace

Effect friction() {
  Effect e;
  e.id = e.family = "friction";
  e.title = "Friction";
  e.cause = "Guideways, cables, wipers. Flexure stages have none.";
  e.equation =
      "F = stiffness*(z + contact_time*z'),  z' = v - |v|*z/distance: sticks like a spring, slips at "
      "stiffness*distance; without a mass "
      "y = u - level*z/distance, v of y";
  e.source =
      "Dahl, AIAA J. 14 (1976) 1675; richer: Canudas de Wit, Olsson, Astrom, Lischinsky, IEEE Trans. Autom. Control 40 "
      "(1995) 419";
  e.residual = "A force error of the sign of the velocity, with spikes where the motion turns.";
  e.needs = "Several reversals, slow and fast ones.";
  e.way = Way::insert;
  e.block_type = "sliding_friction";
  e.places = {"command", "core"};
  e.behind_core = true;
  e.variation = "presliding";
  e.else_a_block = true;
  e.is_memory = true;
  e.parameters = {
      {"contact_stiffness", "N/m", "while it sticks", ""},
      {"slip_distance", "m", "after which it slides", "0.1 .. 50 um"},
      {"excess", "", "richer law: breakaway over the friction of fast sliding, less one", "0 .. 1"},
      {"stribeck_velocity", "m/s", "at which the excess is gone", "0.1 .. 10 mm/s"},
      {"contact_time", "s", "richest law: damping over stiffness of the contact while it sticks", ""},
      {"level", "unit of the wire",
       "on a wire that carries a speed: friction over the damping behind it; a motion: what is held back", ""},
      {"crossover", "m/s", "there: below it flows like a fluid (dampers with a yield force)", ""}};
  e.look_alikes = {{"hysteresis", "load_pair", "friction grows with the load and needs a guide"},
                   {"saturation", "triangle", "friction has a loop where the motion turns, a clamp has none"},
                   {"backlash", "triangle", "lost motion is the same at all amplitudes"},
                   {"quadratic_drag", "triangle", "a drag grows with the square of the speed, at low speed it is gone"},
                   {"stiffening", "sine_amplitudes", "a stiffening spring has no memory"}};
  e.summary = [](const Law&, const std::vector<double>& values, const Circumstances& at) {
    if (at.by.empty() && is_motion(at.unit))
      return fmt::format(
          "{:.3g} {} held back, after {:.3g} {}{}", at.unit.difference_from_si(values[0]), at.unit.text,
          at.unit.difference_from_si(values[1]), at.unit.text,
          values.size() > 2 ? fmt::format(", {:.2g} % more before it slides fast", 100 * values[2]) : "");
    if (at.by.empty())
      return fmt::format("as much as the damping at {:.3g} % of the largest speed",
                         100 * values[0] / std::max({std::abs(at.lowest), std::abs(at.highest), 1e-300}));
    return fmt::format("{:.3g} N ({:.2g} % of the force), after {:.3g} um", values[0] * values[1],
                       100 * values[0] * values[1] / std::max(at.range(), 1e-300), values[1] * 1e6);
  };
  e.laws = [](const Circumstances& at) {
    if (at.by.empty() && is_motion(at.unit)) return std::vector<Law>{on_a_motion(at, false), on_a_motion(at, true)};
    if (at.by.empty()) return std::vector<Law>{on_a_speed(at, false), on_a_speed(at, true)};
    Law law;
    law.name = "presliding (Dahl)";
    law.block.type = "mass_with_presliding";
    const double range = travel(at), force = at.range() > 0 ? at.range() : 1;
    give(law.block, "contact_stiffness", NumberList{with_unit(0.5 * force / range, parse_unit("N/m"))});
    give(law.block, "slip_distance", NumberList{with_unit(0.02 * range, parse_unit("um"))});
    LawParameter k;
    k.path = element("contact_stiffness", 0);
    k.start = 0.5 * force / range;
    k.lower = 1e-5 * force / range;
    k.upper = 1e4 * force / range;
    k.log_scale = true;
    for (const double f : {0.1, 1.0, 10.0}) k.scan.push_back(f * force / range);
    LawParameter d;
    d.path = element("slip_distance", 0);
    d.start = 0.02 * range;
    d.lower = 1e-4 * range;
    d.upper = 10 * range;
    d.log_scale = true;
    for (const double f : {0.003, 0.02, 0.1}) d.scan.push_back(f * range);
    d.plausible_upper = 50e-6;
    law.free = {k, d};
    Law sticky = with_excess(law, range / std::max(at.shortest_step, 1e-9), parse_unit("m/s"));
    sticky.name = "presliding with Stribeck's excess (LuGre)";
    Law damped = with_contact_time(sticky, at);
    damped.name = "presliding with excess and a damped contact (LuGre)";
    return std::vector<Law>{law, sticky, damped};
  };
  e.implausible = [](const Law& law, const std::vector<double>& values, const Circumstances&) -> std::string {
    if (law.block.type != "guide_friction") return "";
    const double level = values[0], slip = values[1];
    if (std::max(level, slip) > 0.99 * law.free[1].upper)
      return "it would slide only behind a tenth of the stroke: that is the actuator's own hysteresis";
    // Dry friction without presliding and a gap obey one law, the play operator.
    return slip < 0.1 * level ? "it sticks fully until it slides: that is lost motion" : "";
  };
  e.unseen = [](const Circumstances& at) -> std::string {
    if (at.by.empty() && is_motion(at.unit) && !at.memory_blocks.empty())
      return fmt::format("the diagram has memory already ({}): another shape of it would be an asymmetry",
                         fmt::join(at.memory_blocks, ", "));
    if (at.by.empty() && !is_speed(at.unit) && !is_motion(at.unit))
      return "friction needs a mass, or a wire that carries a motion or a speed";
    return at.from_data && at.reversals < 2 ? "the motion does not turn twice" : "";
  };
  return e;
}

}  // namespace hysteron::effects
