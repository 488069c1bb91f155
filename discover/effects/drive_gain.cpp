// The effect drive_gain: the device answers its drive by another factor than the model says, on all of its outputs.
#include <fmt/format.h>

#include "discover/hypotheses/effect_terms.h"

namespace hysteron::effects {

Effect drive_gain() {
  Effect e;
  e.id = e.family = "drive_gain";
  e.straight = true;
  e.title = "Gain of the drive";
  e.cause = "The amplifier's gain or the actuator's sensitivity differs from the value in the model.";
  e.equation = "y = f(gain*u)";
  e.source = "data sheets of multilayer stacks, e.g. PiezoDrive SA series: travel +-10 % from part to part";
  e.residual = "The same share of every output that the drive moves, at all frequencies and amplitudes.";
  e.needs =
      "Two measured outputs or more behind one drive: with one output, drive gain and sensor gain cannot be separated.";
  e.way = Way::insert;
  e.block_type = "gain";
  e.places = {"command"};
  e.least_outputs = 2;
  e.parameters = {
      {"gain", "", "true over written drive", "0.9 .. 1.1 usually: the travel of a stack is known to 10 %"}};
  e.look_alikes = {{"calibration", "reference_sensor", "a sensor's gain changes its own reading only"}};
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation&) {
    return fmt::format("gain {:.5g}", values.empty() ? 1.0 : values[0]);
  };
  e.laws = [](const Excitation& at) {
    std::vector<Law> laws;
    if (at.gain_is_free) return laws;
    Law law;
    law.name = "gain";
    law.block.type = "gain";
    give(law.block, "gain", 1.0);
    LawParameter gain;
    gain.path = "gain";
    gain.start = 1;
    gain.scan = {0.9, 1, 1.1};
    gain.plausible_lower = 0.8;  // twice that, so that only a real surprise is flagged
    gain.plausible_upper = 1.25;
    law.free.push_back(gain);
    laws.push_back(std::move(law));
    return laws;
  };
  e.unseen = [](const Excitation& at) -> std::string {
    if (at.gain_is_free) return "a gain is free in the diagram already";
    return at.from_data && at.range() <= 0 ? "the drive does not move" : "";
  };
  return e;
}

}  // namespace hysteron::effects
