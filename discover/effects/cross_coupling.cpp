// The effect cross_coupling: another axis moves this one.
#include <fmt/format.h>

#include <cmath>

#include "discover/effects/library.h"

namespace hysteron::effects {

Effect cross_coupling() {
  Effect e;
  e.id = "cross_coupling";
  e.title = "Coupling from another axis";
  e.cause = "Skewed axes, parasitic motion of flexures, a shared frame, crosstalk of the cables.";
  e.equation = "y = u + coefficient*other";
  e.source = "Rana, Pota, Petersen, American Control Conference (2014) (coupled axes of a scanner)";
  e.residual = "Coherent with the other axis while this one stands still.";
  e.needs = "The other axis recorded, and not in proportion to this one.";
  e.way = Way::insert;
  e.block_type = "cross_coupling";
  e.places = {"core"};
  e.behind_core = true;
  e.side = Side::other_axis;
  e.parameters = {{"coefficient", "unit of the signal per unit of the other axis", "static share of the other axis",
                   "0.1 .. 5 % of this axis' own; a good flexure stage 0.98 % at most"}};
  e.look_alikes = {{"calibration", "axes_independent", "a calibration does not follow the other axis"},
                   {"mains_interference", "zero_run", "the mains is coherent with no axis"}};
  e.family = "cross_coupling";
  e.summary = [](const Law&, const std::vector<double>& values, const Circumstances& at) {
    const double own = at.range() / std::max(at.side_highest - at.side_lowest, 1e-300);
    return fmt::format("{:.3g} % of what this axis does for its own drive", 100 * values[0] / own);
  };
  e.laws = [](const Circumstances& at) {
    Law law;
    law.name = "static";
    law.block.type = "cross_coupling";
    const double own = std::max(at.range(), 1e-30) / std::max(at.side_highest - at.side_lowest, 1e-300);
    const double scale = at.unit.difference_from_si(1) / at.side_unit.difference_from_si(1);
    give(law.block, "coefficient",
         Number{rounded(0.01 * own * scale), "(" + unit_text(at.unit) + ")/(" + unit_text(at.side_unit) + ")"});
    LawParameter c;
    c.path = "coefficient";
    c.start = 0.01 * own;
    c.plausible_lower = -0.1 * own;
    c.plausible_upper = 0.1 * own;
    law.free = {c};
    return std::vector<Law>{law};
  };
  e.unseen = [](const Circumstances& at) -> std::string {
    if (!at.from_data) return "";
    if (!(at.side_highest > at.side_lowest)) return "the other axis does not move";
    return std::abs(at.side_correlation) > 0.9
               ? fmt::format("both axes move alike (correlation {:.2f}, at most 0.9 can be told apart)",
                             at.side_correlation)
               : "";
  };
  e.may_hide = [](const Circumstances& at) { return at.side_highest > at.side_lowest; };  // both axes move alike
  return e;
}

}  // namespace hysteron::effects
