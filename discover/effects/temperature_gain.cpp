// The effect temperature_gain: the stroke per volt changes with temperature.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/hypotheses/effect_terms.h"
#include "discover/hypotheses/room_temperature.h"
#include "fit/signals/unit_words.h"

namespace hysteron::effects {
namespace {

constexpr double least_span = 3;         // [K] of a recorded temperature that shows a gain
constexpr double of_the_air = 0.5;       // [K] a room that is kept at one temperature
constexpr double most_curvature = 1e-3;  // [1/K^2] 0.1 %/K in every kelvin: more bends the gain than moves it
constexpr double work_place = 15;        // [K] beyond what was recorded: another season, another laboratory

/// It does not tell its own reference: the gain is then that of a usual room. What it drifts by the thermometer and the
/// air tell as well.
bool one_temperature(const Excitation& at) { return at.from_data && at.side_highest - at.side_lowest < of_the_air; }

/// `bent`: the change of the gain per kelvin is another one where it is warmer.
Law law(const Excitation& at, bool bent) {
  Law law;
  law.name = bent ? "bent in temperature" : "linear in temperature";
  law.block.type = "temperature_gain";
  const double middle = 0.5 * (at.side_lowest + at.side_highest);
  give(law.block, "sensitivity", Number{0.001, "1/K"});
  give(law.block, "reference",
       at.side_unit.text.empty() ? Number{20, "degC"}
                                 : level(one_temperature(at) ? usual_room(middle) : middle, at.side_unit));
  LawParameter sensitivity;
  sensitivity.path = "sensitivity";
  sensitivity.is_size = true;
  sensitivity.start = 0.001;
  sensitivity.lower = -0.05;
  sensitivity.upper = 0.05;
  sensitivity.plausible_lower = -0.005;
  sensitivity.plausible_upper = 0.01;
  law.free = {sensitivity};
  if (!at.gain_is_free &&
      !one_temperature(at)) {  // else the gain of the model is that at the reference, wherever that is
    LawParameter reference;
    reference.path = "reference";
    reference.beside_size = true;
    reference.start = middle;
    // Sensitivity and reference multiply each other: from a wrong reference the first steps go astray. The user's gain
    // was found at a temperature of these recordings, most often the coldest, that of the room.
    const double span = at.side_highest - at.side_lowest;
    if (at.from_data) reference.scan = {at.side_lowest, at.side_lowest + 0.15 * span, middle, at.side_highest};
    // A model's gain was found where its user works. Far from there, sensitivity times distance is a wrong gain that
    // hardly knows the temperature.
    reference.lower = at.from_data ? at.side_lowest - work_place : middle - 100;
    reference.upper = at.from_data ? at.side_highest + work_place : middle + 100;
    law.free.push_back(reference);
  }
  if (!bent) return law;
  give(law.block, "curvature", Number{0, "1/K^2"});
  LawParameter curvature;
  curvature.path = "curvature";
  curvature.lower = -most_curvature;
  curvature.upper = most_curvature;
  law.free.push_back(curvature);
  return law;
}

/// The temperature at which the gain is the model's lies at the end of where anybody may have worked.
bool is_right_nowhere(const Law& law, const std::vector<double>& values) {
  for (std::size_t i = 0; i < law.free.size(); ++i) {
    const LawParameter& p = law.free[i];
    const double near = 1e-3 * (p.upper - p.lower);
    if (p.path == "reference") return values[i] < p.lower + near || values[i] > p.upper - near;
  }
  return false;
}

}  // namespace

Effect temperature_gain() {
  Effect e;
  e.id = "temperature_gain";
  e.title = "Gain that depends on temperature";
  e.cause = "The piezoelectric coefficient grows with temperature.";
  e.equation = "y = u*(1 + sensitivity*(T - T0) + curvature*(T - T0)^2)";
  e.source =
      "Zheng, Takahashi, Yoshikawa, Uchino, J. Am. Ceram. Soc. 79 (1996) (heat and gain of multilayer actuators)";
  e.residual = "In proportion to (T - T0) times the signal; nothing where the signal is zero.";
  e.needs = "A temperature column that spans 3 K or more, with motion at each temperature.";
  e.way = Way::insert;
  e.block_type = "temperature_gain";
  e.places = {"core"};
  e.behind_core = true;
  e.side = Side::temperature;
  e.parameters = {
      {"sensitivity", "1/K", "relative change of the gain per kelvin", "0.05 .. 0.5 %/K near room temperature"},
      {"reference", "temperature", "at which the gain is that of the model", "near the laboratory's"},
      {"curvature", "1/K^2", "how the change per kelvin changes with temperature",
       "0 in the simple law; the gain rises, or falls, all over the temperatures recorded"}};
  e.look_alikes = {{"thermal_expansion", "temperature_staircase", "expansion shifts the mean, a gain the amplitude"},
                   {"calibration", "temperature_staircase", "a calibration does not change with temperature"},
                   {"ageing", "repeat_after_cycles", "ageing follows the cycles, not the temperature"}};
  e.family = "temperature_gain";
  e.plainer = {"calibration"};  // a constant
  e.summary = [](const Law& law, const std::vector<double>& values, const Excitation& at) {
    std::string text = fraction_text(values[0]) + "/K";
    for (std::size_t i = 1; i < law.free.size(); ++i)
      text += law.free[i].path == "reference"
                  ? fmt::format(" about {:.3g} {}", at.side_unit.from_si(values[i]), at.side_unit.text)
                  : fmt::format(", {:+.2g} %/K more per kelvin", 200 * values[i]);
    return text;
  };
  e.laws = [](const Excitation& at) {
    std::vector<Law> laws{law(at, false)};
    if (!one_temperature(at)) laws.push_back(law(at, true));
    return laws;
  };
  e.implausible = [](const Law& law, const std::vector<double>& values, const Excitation& at) -> std::string {
    if (is_right_nowhere(law, values))
      return fmt::format(
          "the gain of the model would be right {:g} K beyond all that was recorded, the limit: that is a "
          "wrong gain",
          work_place);
    if (law.free.back().path != "curvature" || !at.from_data) return "";
    const double middle = 0.5 * (at.side_lowest + at.side_highest);
    const double reference = law.free[1].path == "reference" ? values[1] : middle;
    const auto slope = [&](double t) { return values[0] + 2 * values.back() * (t - reference); };
    if (slope(at.side_lowest) * slope(at.side_highest) > 0) return "";
    return "it rises and falls within the temperatures recorded: strokes of ceramics rise steadily from -30 to 125 "
           "degC";
  };
  e.seen_by_degrees = true;
  e.unseen = [](const Excitation& at) -> std::string {
    if (!at.from_data) return "";
    const double span = at.side_highest - at.side_lowest;
    return span < least_span ? fmt::format("the temperature spans {:.2g} K, a gain needs 3 K", span) : "";
  };
  e.may_hide = [](const Excitation& at) {
    const double middle = 0.5 * (at.side_lowest + at.side_highest);
    return std::abs(middle - usual_room(middle)) >= least_span;
  };
  return e;
}

}  // namespace hysteron::effects
