// The effect mains_interference: a line of the mains on the sensor's signal, with a phase of its own in each recording.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/hypotheses/effect_terms.h"
#include "fit/signals/unit_words.h"

namespace hysteron::effects {
namespace {

constexpr double away = 0.2;            // [Hz] that the mains is off at most, mostly ...
constexpr double shortest = 0.2;        // [s] ten periods
constexpr double grid_tolerance = 0.5;  // [Hz] ... and for 99.5 % of a year (EN 50160: 1 %)

Law lines(const Excitation& at, int harmonics) {
  Law law;
  law.name = harmonics == 1 ? "one line" : "a line and its harmonics";
  law.block.type = "mains_interference";
  give(law.block, "frequency", Number{50, "Hz"});
  const Number none = with_unit(0.0, at.unit);
  give(law.block, "cosine", NumberList(static_cast<std::size_t>(harmonics), none));
  give(law.block, "sine", NumberList(static_cast<std::size_t>(harmonics), none));
  LawParameter f;
  f.path = "frequency";
  f.start = 50;
  f.lower = 50 - grid_tolerance;
  f.upper = 60 + grid_tolerance;
  // A recording of length T tells frequencies 1/T apart; of longer ones the local search takes care.
  const double step = std::clamp(0.5 / at.longest_recording, 2 * away / 100, 2 * away / 8);
  for (const double mains : {50.0, 60.0}) {
    f.line_bands.emplace_back(mains - grid_tolerance, mains + grid_tolerance);
    for (double d = -away; d <= away * 1.001; d += step) f.scan.push_back(mains + d);
  }
  law.free = {f};
  for (int k = 0; k < harmonics; ++k)
    for (const char* list : {"cosine", "sine"}) {
      LawParameter a;
      a.path = element(list, k);
      a.per_recording = true;
      law.free.push_back(a);
    }
  return law;
}

}  // namespace

Effect mains_interference() {
  Effect e;
  e.id = e.family = "mains_interference";
  e.title = "Interference of the mains";
  e.cause = "Loops of ground and transformers near the sensor's cable.";
  e.equation =
      "y = u + sum_k cosine_k*cos(2*pi*k*f*t) + sine_k*sin(2*pi*k*f*t), amplitudes of their own in each recording";
  e.source = "Ott, Electromagnetic Compatibility Engineering (2009), chapter 3; EN 50160 (frequency of the mains)";
  e.residual = "A line at 50 or 60 Hz that follows neither drive nor motion, there at rest too.";
  e.needs = "A recording sampled above 120 Hz, 0.2 s long or more.";
  e.way = Way::insert;
  e.block_type = "mains_interference";
  e.places = {"measured"};
  e.parameters = {{"frequency", "Hz", "of the mains", "50 or 60 Hz, 0.2 Hz off at most"},
                  {"cosine, sine", "unit of the output", "amplitudes, per recording", "0.1 .. 20 nm at a sensor"}};
  e.look_alikes = {{"structural_resonance", "zero_run", "a mode is silent where nothing moves"},
                   {"cross_coupling", "zero_run", "another axis is silent where nothing moves"}};
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation& at) {
    return fmt::format("{:.5g} Hz, {} in the last recording", values[0],
                       size_text(std::hypot(values[1], values[2]), at.unit));
  };
  e.implausible = [](const Law&, const std::vector<double>& values, const Excitation&) -> std::string {
    if (std::abs(values[0] - 50) <= grid_tolerance || std::abs(values[0] - 60) <= grid_tolerance) return "";
    return fmt::format("no mains runs at {:.4g} Hz: it keeps within {} Hz of 50 or 60", values[0], grid_tolerance);
  };
  e.laws = [](const Excitation& at) { return std::vector<Law>{lines(at, 1), lines(at, 3)}; };
  e.unseen = [](const Excitation& at) -> std::string {
    if (!at.from_data) return "";
    if (at.shortest_step > 1.0 / 120)
      return fmt::format(
          "no recording is sampled above 120 Hz (the quickest: every {}), so 50 Hz looks like something else",
          time_text(at.shortest_step));
    if (at.longest_recording < shortest)
      return fmt::format("the longest recording lasts {}, a line needs {}", time_text(at.longest_recording),
                         time_text(shortest));
    return "";
  };
  return e;
}

}  // namespace hysteron::effects
