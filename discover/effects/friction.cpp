// The effect friction: in the guide of a mass or the bearings of an inertia, beside a damping, on a wire that carries a
// speed, behind a motion without a mass.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/effects/presliding.h"
#include "discover/hypotheses/effect_terms.h"
#include "discover/hypotheses/travel.h"
#include "fit/signals/unit_words.h"

namespace hysteron::effects {
namespace {

/// The contact resists its own motion while it sticks (LuGre's s1/s0): a time, of which nobody knows more than that
/// rows must show it.
Law with_contact_time(Law law, const Excitation& at) {
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
Law on_a_speed(const Excitation& at, bool flows) {
  Law law;
  law.name = flows ? "sticks, flows and slides" : "sticks and slides (Dahl)";
  law.block.type = "sliding_friction";
  const double fast = fastest(at);
  LawParameter level;
  level.path = "level";
  level.is_size = true;
  level.start = 0.1 * fast;
  level.lower = 0;  // it takes energy
  give(law.block, "level", with_unit(level.start, at.unit));
  law.free = {level, give_slip_distance(law, at)};
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

}  // namespace

Effect friction() {
  Effect e;
  e.id = e.family = "friction";
  e.title = "Friction";
  e.cause = "Guideways, cables, wipers. Flexure stages have none.";
  e.equation =
      "F = coulomb*sgn(v), with more at low speed: coulomb*excess*exp(-|v/stribeck_velocity|^d), d = 1, 2; or, giving "
      "way before it slides, F = stiffness*(z + contact_time*z'),  z' = v - |v|*z/distance: sticks like a spring, slips "
      "at stiffness*distance; before an integrator that makes a speed v' = a - level*sgn(v); without a mass "
      "y = u - level*z/distance, v of y; beside a damping b: F = b*(v + level*z/distance)";
  e.source =
      "Dahl, AIAA J. 14 (1976) 1675; richer: Canudas de Wit, Olsson, Astrom, Lischinsky, IEEE Trans. Autom. Control 40 "
      "(1995) 419";
  e.residual = "A force error of the sign of the velocity, with spikes where the motion turns.";
  e.needs = "Several reversals, slow and fast ones.";
  e.way = Way::insert;
  e.block_type = "sliding_friction";
  e.places = {"command", "core", "damping"};
  e.behind_core = true;
  e.variation = "presliding";
  e.or_variation = "friction";
  e.or_where = is_speed;
  e.else_a_block = true;
  e.is_memory = true;
  e.parameters = {
      {"coulomb", "N, N*m", "at any speed, where it does not give way before it slides", ""},
      {"contact_stiffness", "N/m, N*m/rad", "while it sticks", ""},
      {"slip_distance", "m, rad", "after which it slides", "0.1 .. 50 um"},
      {"excess", "", "richer law: breakaway over the friction of fast sliding, less one", "0 .. 1"},
      {"stribeck_velocity", "m/s, rad/s", "at which the excess is gone", "0.1 .. 10 mm/s"},
      {"contact_time", "s", "richest law: damping over stiffness of the contact while it sticks", ""},
      {"level", "unit of the wire",
       "of an integrator that makes a speed: what it takes away of the acceleration; beside a damping, or on a wire "
       "that carries a speed: friction over the damping behind it; a motion: what is held back",
       ""},
      {"crossover", "m/s", "there: below it flows like a fluid (dampers with a yield force)", ""}};
  e.look_alikes = {{"hysteresis", "load_pair", "friction grows with the load and needs a guide"},
                   {"saturation", "triangle", "friction has a loop where the motion turns, a clamp has none"},
                   {"backlash", "triangle", "lost motion is the same at all amplitudes"},
                   {"quadratic_drag", "triangle", "a drag grows with the square of the speed, at low speed it is gone"},
                   {"stiffening", "sine_amplitudes", "a stiffening spring has no memory"}};
  e.summary = [](const Law& law, const std::vector<double>& values, const Excitation& at) {
    if (at.damping) return told_beside_damping(values, at);
    if (at.by.empty() && is_motion(at.unit))
      return fmt::format(
          "lost motion +-{}, reached after {}{}", size_text(values[0], at.unit), size_text(values[1], at.unit),
          values.size() > 2 ? fmt::format(", {:.2g} % more before it slides fast", 100 * values[2]) : "");
    if (at.by.empty())
      return fmt::format("as much as the damping at {:.3g} % of the largest speed",
                         100 * values[0] / std::max({std::abs(at.lowest), std::abs(at.highest), 1e-300}));
    if (makes_a_speed(at)) return told_of_a_speed(values, at);
    const double per_cent = 100 / std::max(driving_range(at), 1e-300);
    if (is_dry(law))
      return fmt::format(
          "{:.3g} {} ({:.2g} % of the {}){}", values[0], turns(at) ? "N m" : "N", per_cent * values[0],
          turns(at) ? "torque" : "force",
          values.size() > 1 ? fmt::format(", {:.2g} % more before it slides fast", 100 * values[1]) : "");
    const double share = per_cent * values[0] * values[1];
    if (turns(at))
      return fmt::format("{:.3g} N m ({:.2g} % of the torque), after {:.3g} mrad", values[0] * values[1], share,
                         values[1] * 1e3);
    const bool far = values[1] >= 1e-3;
    return fmt::format("{:.3g} N ({:.2g} % of the force), after {:.3g} {}", values[0] * values[1], share,
                       values[1] * (far ? 1e3 : 1e6), far ? "mm" : "um");
  };
  e.laws = [](const Excitation& at) {
    if (at.damping) return std::vector<Law>{beside_damping(at), beside_damping_with_excess(at)};
    if (at.by.empty() && is_motion(at.unit)) return std::vector<Law>{guided(at), guided_with_excess(at)};
    if (at.by.empty()) return std::vector<Law>{on_a_speed(at, false), on_a_speed(at, true)};
    if (makes_a_speed(at)) return std::vector<Law>{dry(at), dry_with_excess(at), dry_with_quick_excess(at)};
    const Law sticky = presliding_with_excess(at);
    Law damped = with_contact_time(presliding(at), at), all = with_contact_time(sticky, at);
    damped.name = "presliding in a damped contact";
    all.name = "presliding with excess and a damped contact (LuGre)";
    // The contact first: without it an excess at no speed at all stands for it, and a search that begins there stays.
    std::vector<Law> laws{presliding(at), damped, all, sticky};
    if (can_be_dry(at)) laws.insert(laws.end(), {dry(at), dry_with_excess(at), dry_with_quick_excess(at)});
    return laws;
  };
  e.implausible = [](const Law& law, const std::vector<double>& values, const Excitation&) -> std::string {
    if (law.block.type != "guide_friction") return "";
    const double level = values[0], slip = values[1];
    if (std::max(level, slip) > 0.99 * law.free[1].upper)
      return "it would slide only beyond a tenth of the stroke: that is hysteresis of the actuator, not friction";
    // Dry friction without presliding and a gap obey one law, the play operator.
    return slip < 0.1 * level ? "it sticks fully until it slides: that is backlash, not friction" : "";
  };
  e.unsure = [](const Excitation& at) -> std::string {
    if (at.damping) return "";  // a speed passes all that are below it
    return one_speed(at, 3, "tell it from what grows with the speed");
  };
  e.unseen = [](const Excitation& at) -> std::string {
    if (at.by.empty() && is_motion(at.unit) && !at.memory_blocks.empty())
      return fmt::format("the diagram has memory already ({}): another shape of it would be an asymmetry",
                         fmt::join(at.memory_blocks, ", "));
    if (at.damping && *at.damping == 0) return no_damping;
    if (at.by.empty() && !at.damping && !is_speed(at.unit) && !is_motion(at.unit))
      return "friction needs a mass or an inertia, a damping, or a wire that carries a motion or a speed";
    return at.from_data && at.reversals < 2 ? "the motion does not turn twice" : "";
  };
  return e;
}

}  // namespace hysteron::effects
