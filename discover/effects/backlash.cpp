// The effect backlash: lost motion after every reversal.
#include <fmt/format.h>

#include "discover/effects/library.h"

namespace hysteron::effects {

Effect backlash() {
  Effect e;
  e.id = "backlash";
  e.title = "Backlash";
  e.cause = "Clearance between drive and load: a lead screw, a coupling, a loose clamp.";
  e.equation = "y = max(u - radius, min(u + radius, y before))";
  e.source = "EFFECTS 3, backlash";
  e.residual = "A dead band of the same width after every reversal, whatever the amplitude.";
  e.needs = "Reversals at amplitudes that differ five times.";
  e.way = Way::insert;
  e.block_type = "play";
  e.places = {"core"};
  e.behind_core = true;
  e.commutes = Commutes::gains;
  e.is_memory = true;
  e.moves_zero = true;
  e.parameters = {{"radius", "unit of the signal", "half the clearance", "1e-4 .. 1e-2 of the travel; 0 for flexures"}};
  e.look_alikes = {{"hysteresis", "triangle", "a loop's share grows with the amplitude, that of backlash falls"},
                   {"friction", "load_pair", "friction needs velocity and grows with the load"}};
  e.family = "backlash";
  e.summary = [](const Law&, const std::vector<double>& values, const Circumstances& at) {
    return fmt::format("{:.3g} {} of lost motion", at.unit.difference_from_si(2 * values[0]), at.unit.text);
  };
  e.laws = [](const Circumstances& at) {
    Law law;
    law.name = "clearance";
    law.block.type = "play";
    const double range = at.range() > 0 ? at.range() : 1;
    give(law.block, "radius", with_unit(0.003 * range, at.unit));
    LawParameter radius;
    radius.path = "radius";
    radius.start = 0.003 * range;
    radius.lower = 0;
    radius.upper = 0.4 * range;
    radius.scan = {0.001 * range, 0.003 * range, 0.01 * range, 0.03 * range, 0.1 * range};
    radius.plausible_upper = 0.02 * range;
    law.free = {radius};
    return std::vector<Law>{law};
  };
  e.unseen = [](const Circumstances& at) -> std::string {
    return at.from_data && at.reversals < 2
               ? fmt::format("{} reversal{}, lost motion needs two", at.reversals, at.reversals == 1 ? "" : "s")
               : "";
  };
  return e;
}

}  // namespace hysteron::effects
