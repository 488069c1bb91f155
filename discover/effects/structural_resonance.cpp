// The effect structural_resonance: the stage rings on its flexures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/hypotheses/effect_terms.h"
#include "fit/signals/excitation.h"

namespace hysteron::effects {
namespace {

// Ratios. Flexures have 0.002 .. 0.05: with twice that it is a phase shifter with four
// parameters, and what never dies out is a line of the drive.
constexpr double least_damping = 5e-4, most_damping = 0.1, searched_damping = 0.2;

/// A mode is known by what is sampled four times a period; one more, beside it, by what is sampled more than twice.
/// Less than five periods a recording do not ring.
double fastest(const Excitation& at, int index = 0) { return (index == 0 ? 0.25 : 0.45) / at.shortest_step; }
double slowest(const Excitation& at) { return std::min(5 / at.longest_recording, fastest(at) / 100); }

LawParameter frequency_of(const Excitation& at, int index) {
  LawParameter p;
  p.path = element("frequencies", index);
  p.start = fastest(at, index) / 3;
  p.lower = slowest(at);
  p.upper = fastest(at, index);
  p.log_scale = true;
  // The next mode is searched together with what is known of the first: a decade and a half are enough, for modes of
  // one stage that both show are neighbours.
  const double below = index == 0 ? 1000 : 30;
  p.scan = per_decade(std::max(slowest(at), fastest(at, index) / below), 0.95 * fastest(at, index), 12);
  return p;
}

LawParameter damping_of(int index) {
  LawParameter p;
  p.path = element("dampings", index);
  p.start = 0.03;
  p.lower = least_damping;
  p.upper = searched_damping;
  p.log_scale = true;
  p.plausible_upper = 0.05;
  return p;
}

/// Linear, and then it matters not where it begins; before a curve it is not, and at 0 no frequency shows.
LawParameter residue(const std::string& list, int index, double start) {
  LawParameter p;
  p.path = element(list, index);
  p.start = start;
  p.lower = -2;
  p.upper = 2;
  return p;
}

/// So many modes, searched where they are not plausible, too, to be told what they are.
Law modes(const Excitation& at, int count) {
  Law law;
  law.name = count == 1 ? "one mode" : "two modes";
  law.block.type = "modes";
  const std::vector<double> none(static_cast<std::size_t>(count), 0.0);
  std::vector<double> frequencies, dampings;
  for (int k = 0; k < count; ++k) {
    const auto frequency = frequency_of(at, k);
    const auto damping = damping_of(k);
    frequencies.push_back(frequency.start);
    dampings.push_back(damping.start);
    for (const auto& p : {frequency, damping, residue("positions", k, k == 0 ? 0.5 : 0), residue("velocities", k, 0)})
      law.free.push_back(p);
  }
  give(law.block, "frequencies", with_unit(frequencies, parse_unit("Hz")));
  give(law.block, "dampings", with_unit(dampings, Unit{}));
  give(law.block, "positions", with_unit(none, Unit{}));
  give(law.block, "velocities", with_unit(none, Unit{}));
  return law;
}

/// Of the values of a law: frequency, damping and two residues of each mode.
constexpr std::size_t numbers_of_a_mode = 4;

std::string tell_modes(const Law&, const std::vector<double>& values, const Excitation&) {
  std::string text;
  for (std::size_t k = 0; k + numbers_of_a_mode <= values.size(); k += numbers_of_a_mode)
    text += fmt::format("{}{:.4g} Hz, damping {:.2g}, {:.2g} % of the motion", text.empty() ? "" : "; ", values[k],
                        values[k + 1], 100 * std::hypot(values[k + 2], values[k + 3]));
  return text;
}

/// Two that lie within their half widths are one.
bool is_own(const Resonance& own, double frequency, double damping) {
  return own.damping < most_damping && std::abs(frequency - own.frequency) < (damping + own.damping) * own.frequency;
}

/// The mode that adds most must ring; what one more does beside it refines the shape.
std::string why_no_mode(const Law&, const std::vector<double>& values, const Excitation& at) {
  double most = -1, damping = 0, frequency = 0;
  for (std::size_t k = 0; k + numbers_of_a_mode <= values.size(); k += numbers_of_a_mode)
    if (const double adds = std::hypot(values[k + 2], values[k + 3]); adds > most) {
      most = adds;
      frequency = values[k];
      damping = values[k + 1];
    }
  for (std::size_t k = 0; k + numbers_of_a_mode <= values.size(); k += numbers_of_a_mode)
    if (const int order = harmonic_order(values[k], at.drive_cycles); order > 0)
      return fmt::format(
          "at {:.4g} Hz, {} times the frequency of the drive, it is a harmonic of it: of a curve, a loop or friction",
          values[k], order);
  if (damping > most_damping)
    return fmt::format("with its damping of {:.2g}, more than {}, it would shift the phase and not ring", damping,
                       most_damping);
  if (damping < 1.01 * least_damping)
    return fmt::format("at its damping of {:.2g}, the limit, it would never stop ringing", damping);
  if (frequency > 0.99 * fastest(at))
    return fmt::format("at {:.4g} Hz, sampled no more than four times a period, it would not be seen to ring",
                       frequency);
  for (const auto& own : at.own_resonances)
    if (is_own(own, frequency, damping))
      return fmt::format(
          "at {:.4g} Hz it is the model's own resonance at {:.4g} Hz once more: what the laws that stand leave rings "
          "there",
          frequency, own.frequency);
  return "";
}

}  // namespace

Effect structural_resonance() {
  Effect e;
  e.id = "structural_resonance";
  e.title = "Resonance of the structure";
  e.cause = "The mass of the stage on the stiffness of actuator and flexures.";
  e.equation =
      "y = u + position*(q - u) + velocity*q'/w,  q'' + 2*damping*w*q' + w^2*q = w^2*u,  w = 2*pi*frequency; two "
      "modes: the "
      "sum of what two such add";
  e.source = "Devasia, Eleftheriou, Moheimani, IEEE Trans. Control Syst. Technol. 15 (2007) 802";
  e.residual = "Ringing after steps and corners, a gain that rises towards the frequency, the same at all amplitudes.";
  e.needs =
      "Steps or corners, or motion up to the frequency, sampled four times a period; a second mode beside it 2.2 "
      "times.";
  e.way = Way::insert;
  e.commutes = Commutes::linear;
  e.block_type = "modes";
  e.places = {"core"};
  e.behind_core = true;
  e.parameters = {
      {"frequencies", "Hz", "undamped natural frequency", "100 Hz .. 10 kHz for piezo stages"},
      {"dampings", "", "damping ratio", "0.002 .. 0.05 for flexures; above 0.1 it would only shift the phase"},
      {"positions, velocities", "", "residues: share of the motion that each mode adds", ""}};
  e.look_alikes = {{"amplifier_lag", "fast_steps", "a lag creeps to the level, a resonance rings about it"},
                   {"sensor_lag", "fast_steps", "a lag creeps to the level, a resonance rings about it"},
                   {"dead_time", "fast_steps", "a delay repeats the step, a resonance rings about the level"}};
  e.family = "structural_resonance";
  e.summary = tell_modes;
  e.laws = [](const Excitation& at) { return std::vector<Law>{modes(at, 1), modes(at, 2)}; };
  e.implausible = why_no_mode;
  e.unseen = [](const Excitation& at) -> std::string {
    if (at.unit.dimension == parse_unit("K").dimension)
      return "a temperature does not ring: conduction of heat has real poles only";
    return stands_still(at);
  };
  return e;
}

}  // namespace hysteron::effects
