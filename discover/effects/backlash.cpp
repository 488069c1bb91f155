// The effect backlash: lost motion after every reversal.
#include <fmt/format.h>

#include "discover/hypotheses/effect_terms.h"

namespace hysteron::effects {
namespace {

constexpr double no_gap = 1e-6;  // of the range: what a fit leaves where it does not need any

}  // namespace

Effect backlash() {
  Effect e;
  e.id = "backlash";
  e.title = "Backlash";
  e.cause = "Clearance between drive and load: a lead screw, a coupling, a loose clamp.";
  e.equation = "y = max(u - gap/2, min(u + gap/2, y before))";
  e.source = "Nordin, Gutman, Automatica 38 (2002) 1633";
  e.residual = "A dead band of the same width after every reversal, whatever the amplitude.";
  e.needs = "Reversals at amplitudes that differ five times.";
  e.way = Way::insert;
  e.block_type = "backlash";
  e.places = {"core"};
  e.behind_core = true;
  e.commutes = Commutes::gains;
  e.is_memory = true;
  e.moves_zero = true;
  e.parameters = {{"gap", "unit of the signal", "clearance", "2e-4 .. 2e-2 of the travel; 0 for flexures"}};
  e.look_alikes = {{"hysteresis", "triangle", "a loop's share grows with the amplitude, that of backlash falls"},
                   {"friction", "load_pair", "friction needs velocity and grows with the load"}};
  e.family = "backlash";
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation& at) {
    return fmt::format("{:.3g} {} of lost motion", at.unit.difference_from_si(values[0]), at.unit.text);
  };
  e.laws = [](const Excitation& at) {
    Law law;
    law.name = "clearance";
    law.block.type = "backlash";
    const double range = at.range() > 0 ? at.range() : 1;
    give(law.block, "gap", with_unit(0.006 * range, at.unit));
    LawParameter gap;
    gap.path = "gap";
    gap.start = 0.006 * range;
    gap.lower = 0;
    gap.upper = 0.8 * range;
    gap.scan = {0.002 * range, 0.006 * range, 0.02 * range, 0.06 * range, 0.2 * range};
    gap.plausible_upper = 0.04 * range;
    law.free = {gap};
    return std::vector<Law>{law};
  };
  e.implausible = [](const Law&, const std::vector<double>& values, const Excitation& at) -> std::string {
    return values[0] < no_gap * at.range() ? "without lost motion it is only a zero" : "";
  };
  e.unsure = [](const Excitation& at) -> std::string {
    if (!at.from_data || at.swings.size_ratio >= 5) return "";
    return fmt::format("the largest swing is {:.2g} times the smallest, five times would tell it from hysteresis",
                       at.swings.size_ratio);
  };
  e.unseen = [](const Excitation& at) -> std::string {
    return at.from_data && at.reversals < 2
               ? fmt::format("{} reversal{}, lost motion needs two", at.reversals, at.reversals == 1 ? "" : "s")
               : "";
  };
  return e;
}

}  // namespace hysteron::effects
