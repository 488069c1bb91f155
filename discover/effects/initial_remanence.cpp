// The effect initial_remanence: the actuator did not start from its virgin state.
#include <fmt/format.h>

#include "discover/hypotheses/effect_terms.h"

namespace hysteron::effects {

Effect initial_remanence() {
  Effect e;
  e.id = "initial_remanence";
  e.title = "Initial remanence";
  e.cause =
      "What the actuator went through before the recording still shows: its domains do not start from the virgin "
      "state.";
  e.equation = "the memory starts as after a visit to the input value `before`";
  e.source = "Brokate, Sprekels, Hysteresis and Phase Transitions (1996), chapter 2 (memory of the past)";
  e.residual = "Only until the first full pair of reversals; exactly zero afterwards. Up to half the loop.";
  e.needs = "A block with memory in the diagram.";
  e.way = Way::vary;
  e.parameter = "before";
  e.places = {"core"};
  e.is_memory = true;
  e.parameters = {{"before", "unit of the block's input", "input value visited before the start",
                   "within the drive's range of the device"}};
  e.look_alikes = {{"hysteresis", "precycle", "everywhere against first cycle only"}};
  e.family = "initial_remanence";
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation& at) {
    return fmt::format("as after a visit to {:.4g} {}", at.unit.difference_from_si(values.front()), at.unit.text);
  };
  e.laws = [](const Excitation& at) {
    Law law;
    law.name = "one value";
    give(law.block, "before", with_unit(0.0, at.unit));
    LawParameter before;
    before.path = "before";
    // Both signs: beyond a threshold the value no longer matters, so a fit sees no gradient there and must be scanned.
    const double range = std::max(at.range(), 1e-30);
    // Small ones too: at zero itself a one-sided operator feels one sign only.
    for (const double f : {-1.0, -0.6, -0.3, -0.1, -0.03, -0.01, -0.003, -0.001, 0.001, 0.003, 0.01, 0.03, 0.1, 0.2,
                           0.35, 0.5, 0.7, 0.9, 1.1})
      before.scan.push_back(f * range);
    before.lower = -1.5 * range;
    before.upper = 1.5 * range;
    law.free.push_back(before);
    return std::vector<Law>{law};
  };
  e.unseen = [](const Excitation& at) -> std::string {
    if (at.from_data && at.range() <= 0) return "the input of the memory does not move";
    return "";
  };
  return e;
}

}  // namespace hysteron::effects
