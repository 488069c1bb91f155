// The effects of a tank that its linear model does not have: sqrt_outflow (the outlet follows the root of the level)
// and overflow (the level ends at the brim, and what spills is gone).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "discover/effects/library.h"

namespace hysteron::effects {
namespace {

double travelled(const Circumstances& at) { return at.travel_highest - at.travel_lowest; }

/// An outlet by the root has the flow of the linear one at the middle of the levels where it has this share of it at
/// the reference level.
double share_of_root(const Circumstances& at) {
  const double middle = 0.5 * (at.travel_lowest + at.travel_highest);
  return at.from_data && at.reference > 0 && middle > 0 ? std::sqrt(middle / at.reference) : 1;
}

std::string level_stands(const Circumstances& at) {
  return at.from_data && !(travelled(at) > 0) ? "the level does not move" : "";
}

}  // namespace

Effect sqrt_outflow() {
  Effect e;
  e.id = e.family = "sqrt_outflow";
  e.title = "Outflow through an orifice";
  e.cause = "Water leaves an orifice with the speed of its fall: the outflow follows the root of the level.";
  e.equation = "area*h' = q - outlet*sqrt(h/reference)";
  e.source = "Torricelli's law; Johansson, IEEE Trans. Control Syst. Technol. 8 (2000) 456-465";
  e.residual = "The time constant grows with the root of the level; even and odd harmonics.";
  e.needs = "Levels that differ by a quarter or more.";
  e.way = Way::vary;
  e.variation = "square_root_outflow";
  e.parameters = {{"outlet", "flow", "outflow at the reference level", "that of the linear model near its level"}};
  e.look_alikes = {{"calibration", "sine_amplitudes", "a gain is the same at every level"},
                   {"asymmetry", "fast_steps", "a curve does not change the time constant"},
                   {"overflow", "fast_steps", "an overflow is flat at one level and lacks water afterwards"}};
  e.summary = [](const Law&, const std::vector<double>& values, const Circumstances&) {
    return values.empty() ? "the outflow follows the root of the level, its size is a free number of the diagram"
                          : fmt::format("{:.3g} m^3/s [SI] at the reference level", values[0]);
  };
  e.laws = [](const Circumstances& at) {
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
    return std::vector<Law>{law};
  };
  e.unseen = [](const Circumstances& at) -> std::string {
    if (auto still = level_stands(at); !still.empty()) return still;
    const double share = at.travel_highest > 0 ? travelled(at) / at.travel_highest : 1;
    return at.from_data && share < 0.25
               ? fmt::format("the level spans {:.0f} % of its height, a root needs 25 %", 100 * share)
               : "";
  };
  return e;
}

Effect overflow() {
  Effect e;
  e.id = e.family = "overflow";
  e.title = "Overflow";
  e.cause = "The tank is full: what flows in beyond its brim is spilled.";
  e.equation = "h = min(h, brim), and the surplus is gone";
  e.source = "Johansson, IEEE Trans. Control Syst. Technol. 8 (2000) 456-465 (tanks with a brim)";
  e.residual = "Flat tops, and a level that is too low afterwards.";
  e.needs = "Recordings in which the tank would rise above its brim, and what follows.";
  e.way = Way::vary;
  e.variation = "overflow";
  e.parameters = {{"brim", "level", "at which it runs over", "within the levels of the model without a brim"}};
  e.look_alikes = {{"saturation", "fast_steps", "a sensor that is full shows the right level as soon as it can again"},
                   {"sqrt_outflow", "fast_steps", "an outlet has no flat tops"}};
  e.summary = [](const Law&, const std::vector<double>& values, const Circumstances&) {
    return fmt::format("brim at {:.4g} m", values[0]);
  };
  e.laws = [](const Circumstances& at) {
    Law law;
    law.name = "brim";
    law.block.type = "tank";
    const auto height = [&](double share) { return at.travel_lowest + share * std::max(travelled(at), 1e-30); };
    give(law.block, "brim", with_unit(height(0.9), parse_unit("m")));
    LawParameter brim;
    brim.path = "brim";
    brim.start = height(0.9);
    brim.lower = height(0.3);
    brim.upper = height(1.0);
    brim.scan = {height(0.5), height(0.65), height(0.8), height(0.92)};
    law.free = {brim};
    return std::vector<Law>{law};
  };
  e.unseen = level_stands;
  return e;
}

}  // namespace hysteron::effects
