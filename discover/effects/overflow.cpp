// The effect overflow: the level of a tank ends at the brim, and what spills is gone.
#include <fmt/format.h>

#include <algorithm>

#include "discover/hypotheses/effect_terms.h"
#include "discover/hypotheses/travel.h"

namespace hysteron::effects {

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
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation&) {
    return fmt::format("brim at {:.4g} mm", 1e3 * values[0]);
  };
  e.laws = [](const Excitation& at) {
    Law law;
    law.name = "brim";
    law.block.type = "tank";
    const double most = at.travel_highest - at.travel_lowest;
    const auto height = [&](double share) { return at.travel_lowest + share * std::max(most, 1e-30); };
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
  e.unseen = [](const Excitation& at) { return stands(at, "the level"); };
  return e;
}

}  // namespace hysteron::effects
