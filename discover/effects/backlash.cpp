// The effect backlash: lost motion after every reversal, on a wire or between the sides of a transmission.
#include <fmt/format.h>

#include <numbers>

#include "discover/hypotheses/effect_terms.h"
#include "discover/hypotheses/travel.h"
#include "fit/signals/unit_words.h"

namespace hysteron::effects {
namespace {

constexpr double no_gap = 1e-6;  // of the range: what a fit leaves where it does not need any

/// What the driven side of a transmission moves by, for an angle of the driver on the wire.
struct DrivenSide {
  double per_angle;      ///< [1] of a gear, [m/rad]
  const char* unit;      ///< of its way
  const char* readable;  ///< in which its play is told
  double smaller;        ///< of these in one of `unit`
};
DrivenSide driven_side(const Excitation& at) {
  if (const double pitch = own_number(at, "pitch", 0); pitch > 0)
    return {pitch / (2 * std::numbers::pi), "m", "um", 1e6};
  if (const double radius = own_number(at, "radius", 0); radius > 0) return {radius, "m", "um", 1e6};
  return {1 / own_number(at, "ratio", 1), "rad", "mrad", 1e3};
}
/// [SI] of the signal on the wire, or of the driven side where a transmission stands there.
double way(const Excitation& at) { return at.by.empty() ? at.range() : at.range() * driven_side(at).per_angle; }

/// In a transmission that has none: its own law, with a gap.
Law in_a_transmission(const Excitation& at) {
  const double moved = way(at) > 0 ? way(at) : 1;
  Law law;
  law.name = "play in a transmission";
  law.block.type = at.by;
  LawParameter gap;
  gap.path = "gap";
  gap.is_size = true;
  gap.lower = 0;
  gap.upper = 0.8 * moved;
  gap.scan = per_decade(0.002 * moved, 0.2 * moved, 2);
  gap.start = 0.006 * moved;
  give(law.block, "gap", with_unit(gap.start, parse_unit(driven_side(at).unit)));
  law.free = {gap};
  return law;
}

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
  e.variation = "backlash";
  e.else_a_block = true;
  e.places = {"core", "measured"};
  e.behind_core = true;
  e.commutes = Commutes::gains;
  e.is_memory = true;
  e.moves_zero = true;
  e.parameters = {{"gap", "unit of the signal; rad of a gear, m of a belt or a screw",
                   "clearance, in a transmission seen from the driven side",
                   "2e-4 .. 2e-2 of the travel; 0 for flexures"}};
  e.look_alikes = {{"hysteresis", "triangle", "a loop's share grows with the amplitude, that of backlash falls"},
                   {"friction", "load_pair", "friction needs velocity and grows with the load"}};
  e.family = "backlash";
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation& at) {
    if (const DrivenSide side = driven_side(at); !at.by.empty())
      return fmt::format("{:.3g} {} of play, seen from the driven side", side.smaller * values[0], side.readable);
    return fmt::format("{} of lost motion", size_text(values[0], at.unit));
  };
  e.laws = [](const Excitation& at) {
    if (!at.by.empty()) return std::vector<Law>{in_a_transmission(at)};
    Law law;
    law.name = "clearance";
    law.block.type = "backlash";
    const double range = at.range() > 0 ? at.range() : 1;
    give(law.block, "gap", with_unit(0.006 * range, at.unit));
    LawParameter gap;
    gap.path = "gap";
    gap.is_size = true;
    gap.start = 0.006 * range;
    gap.lower = 0;
    gap.upper = 0.8 * range;
    gap.scan = {0.002 * range, 0.006 * range, 0.02 * range, 0.06 * range, 0.2 * range};
    gap.plausible_upper = 0.04 * range;
    law.free = {gap};
    return std::vector<Law>{law};
  };
  e.implausible = [](const Law&, const std::vector<double>& values, const Excitation& at) -> std::string {
    return values[0] < no_gap * way(at) ? "without lost motion it is only a zero" : "";
  };
  e.unsure = [](const Excitation& at) -> std::string {
    if (!at.from_data || at.swings.size_ratio >= 5 || !at.by.empty()) return "";
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
