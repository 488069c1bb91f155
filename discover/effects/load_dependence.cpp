// The effect load_dependence: a force shortens the actuator, and takes part of its stroke.
#include <fmt/format.h>

#include <algorithm>

#include "discover/hypotheses/effect_terms.h"
#include "fit/signals/unit_words.h"

namespace hysteron::effects {

Effect load_dependence() {
  Effect e;
  e.id = e.family = "load_dependence";
  e.title = "Load";
  e.cause =
      "A weight, a preload, the process itself: an actuator gives way like a spring, and polarises less under load.";
  e.equation = "y = u*(1 - softening*F) - compliance*F";
  e.source =
      "Fleming, Leang, Design, Modeling and Control of Nanopositioning Systems (2014), chapter 2; PI Ceramic tutorial, "
      "forces and stiffness";
  e.residual = "Follows the force (an offset), or the force times the signal (a gain).";
  e.needs = "A recorded force that moves, not in step with the drive.";
  e.way = Way::insert;
  e.block_type = "load_dependence";
  e.places = {"core"};
  e.behind_core = true;
  e.side = Side::force;
  e.parameters = {{"compliance", "unit of the signal per N", "one over the stiffness", "1/(5 .. 500 N/um)"},
                  {"softening", "1/N", "part of the stroke that a newton takes", "kS/kT below a tenth"}};
  e.look_alikes = {{"calibration", "load_pair", "a calibration is the same with and without the load"},
                   {"temperature_gain", "load_pair", "the temperature is the same with and without the load"}};
  e.summary = [](const Law& law, const std::vector<double>& values, const Excitation& at) {
    std::string text = size_text(values[0], at.unit) + "/N";
    if (law.free.size() > 1) text += fmt::format(", {:.3g} % of the stroke per newton", 100 * values[1]);
    return text;
  };
  e.laws = [](const Excitation& at) {
    const double force = std::max(at.side_highest - at.side_lowest, 1e-30), range = std::max(at.range(), 1e-30);
    Law law;
    law.name = "compliance";
    law.block.type = "load_dependence";
    const std::string unit = unit_text(at.unit);
    give(law.block, "compliance",
         Number{rounded(at.unit.difference_from_si(0.01 * range / force)), unit.empty() ? "1/N" : "(" + unit + ")/N"});
    give(law.block, "softening", Number{0, "1/N"});
    LawParameter compliance;
    compliance.path = "compliance";
    compliance.is_size = true;
    compliance.start = 0.01 * range / force;
    law.free = {compliance};
    Law more = law;
    more.name = "compliance and stroke";
    LawParameter softening;
    softening.path = "softening";
    softening.lower = -1 / force;
    softening.upper = 1 / force;
    more.free.push_back(softening);
    return std::vector<Law>{law, more};
  };
  e.unseen = [](const Excitation& at) -> std::string {
    if (!at.from_data) return "";
    if (!(at.side_highest > at.side_lowest)) return "the force does not move";
    // With less than this the two are one signal: whatever is put down to the force may be the drive's.
    if (at.side_correlation > 0.95 || at.side_correlation < -0.95) return "the force moves in step with the signal";
    return "";
  };
  return e;
}

}  // namespace hysteron::effects
