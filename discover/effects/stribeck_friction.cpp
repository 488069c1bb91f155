// The effect stribeck_friction: dry friction that falls while a body gets under way.
#include <fmt/format.h>

#include "discover/effects/presliding.h"
#include "discover/hypotheses/effect_terms.h"
#include "discover/hypotheses/travel.h"
#include "fit/signals/unit_words.h"

namespace hysteron::effects {

Effect stribeck_friction() {
  Effect e;
  e.id = "stribeck_friction";
  e.family = e.law_of = "friction";
  e.title = "Friction that falls with the speed";
  e.cause = "A lubricated contact: at rest it has to be broken away, in fast motion it floats.";
  e.equation =
      "F = sgn(v)*level*(1 + excess*exp(-(v/stribeck_velocity)^2)); the sign is rounded over slip_distance, viscous "
      "friction is the model's own damping";
  e.source =
      "Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994) 1083; Canudas de Wit, Olsson, "
      "Astrom, Lischinsky, IEEE Trans. Autom. Control 40 (1995) 419";
  e.residual = "A force error odd in the velocity, that falls from its largest value at low speed.";
  e.needs = "Steady motion at six speeds or more of both signs, some below the one at which the excess is gone.";
  e.way = Way::insert;
  e.block_type = "guide_friction";
  e.places = {"core", "damping"};
  e.behind_core = true;
  e.variation = "presliding";
  e.or_variation = "friction";
  e.or_where = is_speed;
  e.else_a_block = true;
  e.is_memory = true;
  e.parameters = {{"contact_stiffness", "N/m, N*m/rad",
                   "of a mass or an inertia: while it sticks; times slip_distance: the level", ""},
                  {"slip_distance", "m", "after which it slides", "0.1 .. 50 um"},
                  {"level", "unit of the wire",
                   "of a motion without a mass: what is held back of it; beside a damping: over that", ""},
                  {"excess", "", "breakaway over the friction of fast sliding, less one", "0 .. 1"},
                  {"stribeck_velocity", "m/s, rad/s", "at which the excess is gone", "0.1 .. 10 mm/s"}};
  e.look_alikes = {{"friction", "triangle", "without the excess it holds as much at every speed"},
                   {"quadratic_drag", "triangle", "a drag rises with the speed, it falls"}};
  e.laws = [](const Excitation& at) {
    if (at.damping) return std::vector<Law>{beside_damping_with_excess(at)};
    if (makes_a_speed(at)) return std::vector<Law>{dry_with_excess(at)};
    return std::vector<Law>{at.by.empty() ? guided_with_excess(at) : presliding_with_excess(at)};
  };
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation& at) {
    if (at.damping) return told_beside_damping(values, at);
    if (makes_a_speed(at)) return told_of_a_speed(values, at);
    const std::string level = at.by.empty() ? "lost motion +-" + size_text(values[0], at.unit)
                                            : fmt::format("{:.3g} {}", values[0] * values[1], turns(at) ? "N m" : "N");
    if (values.size() < 4) return level;
    return fmt::format("{} in fast motion, {:.2g} % more below {:.3g} {}/s", level, 100 * values[2], 1e3 * values[3],
                       turns(at) ? "mrad" : "mm");
  };
  e.unsure = [](const Excitation& at) -> std::string {
    if (at.damping) return "";  // a speed passes all that are below it
    return one_speed(at, 10, "tell what falls with it");
  };
  e.unseen = [](const Excitation& at) -> std::string {
    if (at.damping && *at.damping == 0) return no_damping;
    if (at.by.empty() && !at.damping && !is_motion(at.unit))
      return "it needs a mass or an inertia, a damping, or a wire that carries a motion";
    if (at.by.empty() && !at.damping && !at.memory_blocks.empty())
      return fmt::format("the diagram has memory already ({}): another shape of it would be an asymmetry",
                         fmt::join(at.memory_blocks, ", "));
    return at.from_data && at.reversals < 2 ? "the motion does not turn twice" : "";
  };
  return e;
}

}  // namespace hysteron::effects
