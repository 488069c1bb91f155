// The effect cross_coupling: another axis moves this one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/hypotheses/effect_terms.h"

namespace hysteron::effects {
namespace {

/// The same behind a lag: between as good as at once and as good as a drift.
Law late(Law law, const Excitation& at) {
  law.name = "late";
  law.block.type = "late_cross_coupling";
  give(law.block, "time", with_unit(at.shortest_step, parse_unit("s")));
  LawParameter time;
  time.path = "time";
  time.start = at.shortest_step;
  time.lower = 1e-3 * at.shortest_step;
  time.upper = std::max(at.longest_recording / 20, 10 * at.shortest_step);
  time.log_scale = true;
  time.scan = per_decade(at.shortest_step / 20, time.upper / 2, 2);
  law.free.push_back(time);
  return law;
}

}  // namespace

Effect cross_coupling() {
  Effect e;
  e.id = "cross_coupling";
  e.title = "Coupling from another axis";
  e.cause = "Skewed axes, parasitic motion of flexures, a shared frame, crosstalk of the cables.";
  e.equation = "y = u + coefficient*w, w the other axis, at once or behind a lag (time*w' = other - w)";
  e.source = "Rana, Pota, Petersen, American Control Conference (2014) (coupled axes of a scanner)";
  e.residual = "Coherent with the other axis while this one stands still.";
  e.needs = "The other axis recorded, and not in proportion to this one.";
  e.way = Way::insert;
  e.block_type = "cross_coupling";
  e.places = {"core"};
  e.behind_core = true;
  e.side = Side::other_axis;
  e.parameters = {{"coefficient", "unit of the signal per unit of the other axis", "static share of the other axis",
                   "0.1 .. 5 % of this axis' own; a good flexure stage 0.98 % at most"},
                  {"time", "s", "with which it arrives; frames and cables pass on what is slow",
                   "not known beforehand: a twentieth of the longest recording at most, later it is a drift"}};
  e.look_alikes = {{"calibration", "axes_independent", "a calibration does not follow the other axis"},
                   {"mains_interference", "zero_run", "the mains is coherent with no axis"}};
  e.family = "cross_coupling";
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation& at) {
    const double own = at.range() / std::max(at.side_highest - at.side_lowest, 1e-300);
    return fmt::format("{:.3g} % of what this axis does for its own drive{}", 100 * values[0] / own,
                       values.size() > 1 ? ", late by " + time_text(values[1]) : "");
  };
  e.laws = [](const Excitation& at) {
    Law law;
    law.name = "static";
    law.block.type = "cross_coupling";
    const double own = std::max(at.range(), 1e-30) / std::max(at.side_highest - at.side_lowest, 1e-300);
    const double scale = at.unit.difference_from_si(1) / at.side_unit.difference_from_si(1);
    give(law.block, "coefficient",
         Number{rounded(0.01 * own * scale), "(" + unit_text(at.unit) + ")/(" + unit_text(at.side_unit) + ")"});
    LawParameter c;
    c.path = "coefficient";
    c.is_size = true;
    c.start = 0.01 * own;
    c.plausible_lower = -own;  // what does more than its own drive is a second input, not a coupling
    c.plausible_upper = own;
    law.free = {c};
    return std::vector<Law>{law, late(law, at)};
  };
  e.unseen = [](const Excitation& at) -> std::string {
    if (!at.from_data) return "";
    if (!(at.side_highest > at.side_lowest)) return "the other axis does not move";
    return std::abs(at.side_correlation) > 0.9
               ? fmt::format("both axes move alike (correlation {:.2f}, at most 0.9 can be told apart)",
                             at.side_correlation)
               : "";
  };
  e.may_hide = [](const Excitation& at) { return at.side_highest > at.side_lowest; };  // both axes move alike
  return e;
}

}  // namespace hysteron::effects
