// The effect thermal_expansion: parts between actuator and sensor grow with their temperature, late.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/hypotheses/effect_terms.h"
#include "fit/signals/unit_words.h"

namespace hysteron::effects {
namespace {

/// [s] where the search for the time constant of part k begins.
double first_time(const Excitation& at, int k) { return at.longest_recording / (k == 0 ? 10 : 100); }

/// One or two parts, each late by its own time.
Law parts(const Excitation& at, int n) {
  Law law;
  law.name = n == 1 ? "one time constant" : "two time constants";
  law.block.type = "thermal_expansion";
  const double per_kelvin = 0.01 * std::max(at.range(), 1e-30);
  const std::string unit = unit_text(at.unit);
  NumberList coefficients, times;
  for (int k = 0; k < n; ++k) {
    coefficients.push_back(Number{rounded(at.unit.difference_from_si(per_kelvin)), unit.empty() ? "1/K" : unit + "/K"});
    times.push_back(with_unit(first_time(at, k), parse_unit("s")));
  }
  give(law.block, "coefficients", std::move(coefficients));
  give(law.block, "times", std::move(times));
  for (int k = 0; k < n; ++k) {
    LawParameter c;
    c.path = element("coefficients", k);
    c.start = per_kelvin;
    c.is_size = true;
    law.free.push_back(c);
  }
  for (int k = 0; k < n; ++k) {
    LawParameter time;
    time.path = element("times", k);
    time.start = first_time(at, k);
    time.lower = at.shortest_step / 10;  // as good as at once
    time.upper = 3 * at.longest_recording;  // behind that nothing but a slope is seen
    time.log_scale = true;
    time.scan = per_decade(at.longest_recording / 300, 3 * at.longest_recording, n == 1 ? 2 : 1.5);
    time.plausible_upper = 7200;
    law.free.push_back(time);
  }
  // The user's zero is that of the temperature at which recordings begin, most likely.
  if (at.from_data && !at.side_unit.text.empty()) give(law.block, "reference", level(at.side_at_start, at.side_unit));
  // Where no constant of the diagram takes up the middle, the temperature of no expansion is found too.
  if (!at.zeros.empty() || at.offset_is_free) return law;
  const double middle = 0.5 * (at.side_lowest + at.side_highest);
  if (!at.side_unit.text.empty()) give(law.block, "reference", level(middle, at.side_unit));
  LawParameter reference;
  reference.path = "reference";
  reference.beside_size = true;
  reference.start = middle;
  reference.lower = middle - 200;
  reference.upper = middle + 200;
  law.free.push_back(reference);
  return law;
}

}  // namespace

Effect thermal_expansion() {
  Effect e;
  e.id = "thermal_expansion";
  e.title = "Thermal expansion";
  e.cause = "Stack, frame and sensor mount expand differently, and heat takes its time to reach them.";
  e.equation = "y = u + sum coefficients[k]*(w_k - T0),  times[k]*w_k' = T - w_k";
  e.source = "PI Ceramic tutorial, section 4.36 (expansion of piezo ceramics)";
  e.residual = "Slow, independent of the drive, follows the filtered temperature.";
  e.needs = "A temperature column that spans 0.5 K or more.";
  e.way = Way::insert;
  e.block_type = "thermal_expansion";
  e.places = {"core"};
  e.behind_core = true;
  e.side = Side::temperature;
  e.moves_zero = true;
  e.parameters = {{"coefficients", "unit of the signal per K", "length times difference of the expansions",
                   "-3.5e-6 /K (multilayer stack) .. 23e-6 /K (aluminium) times the length (PI tutorial 4.36)"},
                  {"times", "s", "with which the parts warm up", "30 s .. 2 h"}};
  e.look_alikes = {{"creep", "temperature_constant", "creep follows the last step, expansion the temperature"},
                   {"sensor_drift", "zero_run", "a drift follows neither drive nor temperature"},
                   {"temperature_gain", "temperature_staircase", "expansion shifts the mean, a gain the amplitude"}};
  e.family = "thermal_expansion";
  e.contains = {"pyro_charge_drift"};  // two parts, one of them at once and of the other sign
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation& at) {
    std::string text;
    const std::size_t parts = values.size() / 2;
    for (std::size_t k = 0; k < parts; ++k)
      text += fmt::format("{}{}/K late by {}", k == 0 ? "" : " and ", size_text(values[k], at.unit),
                          time_text(values[parts + k]));
    return text;
  };
  e.laws = [](const Excitation& at) { return std::vector<Law>{parts(at, 1), parts(at, 2)}; };
  e.implausible = [](const Law& law, const std::vector<double>& values, const Excitation&) -> std::string {
    const std::size_t parts = values.size() / 2;
    for (std::size_t k = parts; k < 2 * parts; ++k)
      if (values[k] > 0.99 * law.free[k].upper)
        return "a part would be warming up three times as long as any recording lasts: what is seen of it is a drift";
    return "";
  };
  e.seen_by_degrees = true;
  e.unseen = [](const Excitation& at) -> std::string {
    if (!at.from_data) return "";
    const double span = at.side_highest - at.side_lowest;
    return span < 0.5 ? fmt::format("the temperature spans {:.2g} K, expansion needs 0.5 K", span) : "";
  };
  return e;
}

}  // namespace hysteron::effects
