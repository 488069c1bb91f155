// The effect slew_limit: the drive cannot move faster than the amplifier's current charges the actuator.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/hypotheses/effect_terms.h"

namespace hysteron::effects {
namespace {

/// One rate for both ways, or one for each.
Law limit(const Excitation& at, bool each_way) {
  Law law;
  law.name = each_way ? "one rate for each way" : "one rate";
  law.block.type = "slew_limit";
  // Where the quickest way the one way is not limited, one rate for both that limits the other brings nothing.
  law.apart = each_way;
  // At the quickest motion of the drive in any recording it limits nothing: held at that bound it costs no parameter.
  const double none = at.range() > 0 && at.quickest > 0 ? at.range() * at.quickest : 1;
  give(law.block, "rate", per_second(none, at.unit));
  const auto rates = each_way ? std::vector<std::string>{"rise", "fall"} : std::vector<std::string>{"rate"};
  for (const auto& path : rates) {
    if (each_way) give(law.block, path, per_second(none, at.unit));
    LawParameter rate;
    rate.path = path;
    rate.start = none;
    rate.lower = 1e-6 * none;
    rate.upper = none;
    rate.log_scale = true;
    // A step of one row is far quicker than a sine: the rates that limit the one and not the other lie decades apart.
    // Near the quickest motion a limit acts on the largest steps alone, and no slope leads there from below.
    rate.scan = {none};
    for (const double r : per_decade(1e-5 * none, 0.5 * none, 5)) rate.scan.push_back(r);
    for (const double share : {0.6, 0.7, 0.78, 0.84, 0.88, 0.91, 0.94, 0.96, 0.975, 0.985, 0.993})
      rate.scan.push_back(share * none);
    law.free.push_back(std::move(rate));
  }
  return law;
}

}  // namespace

Effect slew_limit() {
  Effect e;
  e.id = e.family = "slew_limit";
  e.title = "Limited rate of the drive";
  e.cause =
      "The amplifier's largest current into the capacitance of the actuator: |dv/dt| <= I/C; the motor of a valve; a ramp "
      "in a drive.";
  e.equation = "dv/dt = max(-fall, min(rise, (u - v)/time)), time = 1 ns";
  e.source =
      "Fleming, Moheimani, IEEE Trans. Control Syst. Technol. 13 (2005) 33 (current of a capacitive load); PI E-617 "
      "manual; Thorlabs, piezo driver bandwidth (f_max = I/(pi C Vpp))";
  e.residual = "Nothing while the drive moves slower than the limit; beyond it a triangle near the steepest parts.";
  e.needs = "Steps, or fast motion of large amplitude, beyond the limit.";
  e.way = Way::insert;
  e.block_type = "slew_limit";
  e.places = {"command"};
  e.parameters = {{"rate", "unit of the signal per s", "largest rate both ways",
                   "60 mA into 2.6 uF: 23 V/ms; the motor of a valve: the range in a minute"},
                  {"rise, fall", "unit of the signal per s", "largest rate of each way", "of one size"}};
  e.look_alikes = {
      {"amplifier_lag", "sine_amplitudes", "at half the amplitude the error of a limit goes, a lag's halves"},
      {"saturation", "sine_amplitudes", "a clamp has a level, a slew limit a rate"},
      {"dead_time", "sine_amplitudes", "at half the amplitude the error of a limit goes, a delay's halves"},
      {"structural_resonance", "fast_steps", "a resonance rings about the level, a limit makes a ramp"}};
  e.summary = [](const Law& law, const std::vector<double>& values, const Excitation& at) {
    std::string text = fmt::format("at most {:.4g} {}/s", at.unit.difference_from_si(values[0]), at.unit.text);
    if (law.free.size() > 1) text += fmt::format(" upwards, {:.4g} downwards", at.unit.difference_from_si(values[1]));
    return text;
  };
  e.implausible = [](const Law&, const std::vector<double>& values, const Excitation& at) -> std::string {
    // Motors of large valves take minutes from end to end; what no recording sees arrive is not limited but sums up.
    const double whole = at.range() / *std::min_element(values.begin(), values.end());
    if (!at.from_data || whole <= at.longest_recording) return "";
    return fmt::format("the range of the drive would take {}, longer than the longest recording, {}: that is no limit",
                       time_text(whole), time_text(at.longest_recording));
  };
  e.laws = [](const Excitation& at) { return std::vector<Law>{limit(at, false), limit(at, true)}; };
  e.unseen = stands_still;
  return e;
}

}  // namespace hysteron::effects
