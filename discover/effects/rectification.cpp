// The effect rectification: part of the signal loses its sign.
#include <fmt/format.h>

#include "discover/hypotheses/effect_terms.h"

namespace hysteron::effects {

Effect rectification() {
  Effect e;
  e.id = e.family = "rectification";
  e.title = "Rectification";
  e.cause = "A diode, a one-way valve, a sensor that cannot tell the sign.";
  e.equation = "y = (1 - mix)*u + mix*|u|";
  e.source = "Horowitz, Hill, The Art of Electronics (2015), section 1.6";
  e.residual = "Nothing above zero; below it the signal itself. Even harmonics.";
  e.needs = "A signal that changes its sign.";
  e.way = Way::insert;
  e.block_type = "rectifier";
  e.places = {"command", "measured"};
  e.parameters = {{"mix", "", "1: absolute value, 0.5: nothing below zero", "0 .. 1"}};
  e.look_alikes = {{"asymmetry", "sine_amplitudes", "a curve bends everywhere, a rectifier at zero only"},
                   {"sensor_nonlinearity", "sine_amplitudes", "a curve bends everywhere, a rectifier at zero only"},
                   {"saturation", "sine_amplitudes", "a clamp has a level, a rectifier zero"}};
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation&) {
    return fmt::format("{:.3g} of it without its sign", values[0]);
  };
  e.laws = [](const Excitation&) {
    Law law;
    law.name = "mixed";
    law.block.type = "rectifier";
    give(law.block, "mix", 0.0);
    LawParameter mix;
    mix.path = "mix";
    mix.is_size = true;
    mix.start = 0.1;
    mix.lower = -0.1;
    mix.upper = 1.1;
    mix.scan = {0.1, 0.5, 1};
    mix.plausible_lower = 0;
    mix.plausible_upper = 1;
    law.free = {mix};
    return std::vector<Law>{law};
  };
  e.unseen = [](const Excitation& at) -> std::string {
    if (!at.from_data) return "";
    // Rounding of a drive that ends at zero is no sign.
    const double little = 1e-3 * at.range();
    return at.lowest > -little || at.highest < little ? "the signal does not change its sign" : "";
  };
  return e;
}

}  // namespace hysteron::effects
