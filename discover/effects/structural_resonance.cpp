// The effect structural_resonance: the stage rings on its flexures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/effects/library.h"

namespace hysteron::effects {
namespace {

// Ratios. Flexures have 0.002 .. 0.05 (EFFECTS, structural_resonance): with twice that it is a phase shifter with four
// parameters, and what never dies out is a line of the drive.
constexpr double least_damping = 5e-4, most_damping = 0.1, searched_damping = 0.2;

}  // namespace

Effect structural_resonance() {
  Effect e;
  e.id = "structural_resonance";
  e.title = "Resonance of the structure";
  e.cause = "The mass of the stage on the stiffness of actuator and flexures.";
  e.equation = "y = u + position*(q - u) + velocity*q'/w,  q'' + 2*damping*w*q' + w^2*q = w^2*u,  w = 2*pi*frequency";
  e.source = "Devasia, Eleftheriou, Moheimani, IEEE Trans. Control Syst. Technol. 15 (2007) 802";
  e.residual = "Ringing after steps and corners, a gain that rises towards the frequency, the same at all amplitudes.";
  e.needs = "Steps or corners, or motion up to the frequency, sampled four times a period.";
  e.way = Way::insert;
  e.commutes = Commutes::linear;
  e.block_type = "mode";
  e.places = {"core"};
  e.behind_core = true;
  e.parameters = {
      {"frequency", "Hz", "undamped natural frequency", "100 Hz .. 10 kHz for piezo stages"},
      {"damping", "", "damping ratio", "0.002 .. 0.05 for flexures; above 0.1 it would only shift the phase"},
      {"position, velocity", "", "residues: share of the motion that the mode adds", ""}};
  e.look_alikes = {{"amplifier_lag", "fast_steps", "a lag creeps to the level, a resonance rings about it"},
                   {"sensor_lag", "fast_steps", "a lag creeps to the level, a resonance rings about it"},
                   {"dead_time", "fast_steps", "a delay repeats the step, a resonance rings about the level"}};
  e.family = "structural_resonance";
  e.summary = [](const Law&, const std::vector<double>& values, const Circumstances&) {
    return fmt::format("{:.4g} Hz, damping {:.2g}, {:.2g} % of the motion", values[0], values[1],
                       100 * std::hypot(values[2], values[3]));
  };
  e.laws = [](const Circumstances& at) {
    Law law;
    law.name = "one mode";
    law.block.type = "mode";
    // Sampled four times a period at least; slower than five periods a recording it is no ringing.
    const double fastest = 0.25 / at.shortest_step, slowest = std::min(5 / at.longest_recording, fastest / 100);
    give(law.block, "frequency", with_unit(fastest / 3, parse_unit("Hz")));
    give(law.block, "damping", 0.03);
    give(law.block, "position", 0.0);
    give(law.block, "velocity", 0.0);
    LawParameter frequency;
    frequency.path = "frequency";
    frequency.start = fastest / 3;
    frequency.lower = slowest;
    frequency.upper = fastest;
    frequency.log_scale = true;
    frequency.scan = per_decade(std::max(slowest, fastest / 1000), 0.95 * fastest, 12);
    LawParameter damping;
    damping.path = "damping";
    damping.start = 0.03;
    damping.lower = least_damping;
    damping.upper = searched_damping;
    damping.log_scale = true;
    damping.plausible_upper = 0.05;
    LawParameter position, velocity;
    position.path = "position";
    velocity.path = "velocity";
    position.lower = velocity.lower = -2;
    position.upper = velocity.upper = 2;
    law.free = {frequency, damping, position, velocity};
    return std::vector<Law>{law};
  };
  e.implausible = [](const Law&, const std::vector<double>& values, const Circumstances&) -> std::string {
    if (values[1] > most_damping)
      return fmt::format("with its damping of {:.2g}, more than {}, it would shift the phase and not ring", values[1],
                         most_damping);
    if (values[1] < 1.01 * least_damping)
      return fmt::format("at its damping of {:.2g}, the limit, it would never stop ringing", values[1]);
    return "";
  };
  e.unseen = [](const Circumstances& at) -> std::string {
    if (at.unit.dimension == parse_unit("K").dimension)
      return "a temperature does not ring: conduction of heat has real poles only";
    return stands_still(at);
  };
  return e;
}

}  // namespace hysteron::effects
