// The effect sqrt_outflow: the outlet of a tank follows the root of the level.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "discover/hypotheses/effect_terms.h"
#include "discover/hypotheses/travel.h"

namespace hysteron::effects {
namespace {

/// An outlet by the root has the flow of the linear one at the middle of the levels where it has this share of it at
/// the reference level.
double share_of_root(const Excitation& at) {
  const double middle = 0.5 * (at.travel_lowest + at.travel_highest);
  const double reference = own_number(at, "reference", 0);
  return at.from_data && reference > 0 && middle > 0 ? std::sqrt(middle / reference) : 1;
}

/// Pipes and orifices in a row: a power between that of the one and that of the other, the linear outlet to begin with.
Law by_a_power() {
  Law law;
  law.name = "a power of the level";
  law.apart = true;
  law.block.type = "tank";
  give(law.block, "law", Value("power"));
  give(law.block, "exponent", 1.0);
  LawParameter outlet;
  outlet.path = "outlet";
  outlet.start = std::numeric_limits<double>::quiet_NaN();  // as the linear outlet has it
  outlet.lower = 0;
  LawParameter exponent;
  exponent.path = "exponent";
  exponent.start = 1;
  exponent.lower = 0.4;
  exponent.upper = 1;
  exponent.scan = {0.98, 0.75, 0.5};
  law.free = {outlet, exponent};
  return law;
}

}  // namespace

Effect sqrt_outflow() {
  Effect e;
  e.id = e.family = "sqrt_outflow";
  e.title = "Outflow through an orifice";
  e.cause = "Water leaves an orifice with the speed of its fall: the outflow follows the root of the level.";
  e.equation = "area*h' = q - outlet*sqrt(h/reference); richer: (h/reference)^exponent, 1/2 to 1";
  e.source = "Torricelli's law; Johansson, IEEE Trans. Control Syst. Technol. 8 (2000) 456-465";
  e.residual = "The time constant grows with the root of the level; even and odd harmonics.";
  e.needs = "Levels that differ by a quarter or more.";
  e.way = Way::vary;
  e.variation = "square_root_outflow";
  e.parameters = {{"outlet", "flow", "outflow at the reference level", "that of the linear model near its level"},
                  {"exponent", "", "second law: of the level", "1/2 an orifice, 1 a long narrow pipe"}};
  e.look_alikes = {{"calibration", "sine_amplitudes", "a gain is the same at every level"},
                   {"asymmetry", "fast_steps", "a curve does not change the time constant"},
                   {"overflow", "fast_steps", "an overflow is flat at one level and lacks water afterwards"}};
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation&) {
    return values.empty()
               ? "the outflow follows the root of the level, its size is a free number of the diagram"
               : fmt::format("{:.3g} m^3/s [SI] at the reference level{}", values[0],
                             values.size() > 1 ? fmt::format(", which it follows by the power {:.3g}", values[1]) : "");
  };
  e.laws = [](const Excitation& at) {
    Law law;
    law.name = "root of the level";
    law.block.type = "tank";
    give(law.block, "law", Value("square_root"));
    LawParameter outlet;
    outlet.path = "outlet";
    outlet.start = std::numeric_limits<double>::quiet_NaN();  // as the linear outlet has it
    outlet.share = share_of_root(at);
    outlet.lower = 0;
    law.free = {outlet};
    return std::vector<Law>{law, by_a_power()};
  };
  e.unseen = [](const Excitation& at) -> std::string {
    if (auto still = stands(at, "the level"); !still.empty()) return still;
    const double share = at.travel_highest > 0 ? travelled(at) / at.travel_highest : 1;
    return at.from_data && share < 0.25
               ? fmt::format("the level spans {:.0f} % of its height, a root needs 25 %", 100 * share)
               : "";
  };
  return e;
}

}  // namespace hysteron::effects
