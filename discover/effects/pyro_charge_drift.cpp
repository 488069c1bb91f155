// The effect pyro_charge_drift: a change of temperature charges the ceramics, and the charge leaks away.
#include <fmt/format.h>

#include <algorithm>

#include "discover/hypotheses/effect_terms.h"
#include "fit/signals/unit_words.h"

namespace hysteron::effects {

Effect pyro_charge_drift() {
  Effect e;
  e.id = e.family = "pyro_charge_drift";
  e.title = "Pyroelectric charge";
  e.cause =
      "Heat changes the polarisation of the ceramics. Behind a charge drive, a relay or an open plug the charge stays "
      "and leaks away slowly; a voltage amplifier takes it at once, and there is none of this.";
  e.equation = "v = u + w,  dw/dt = coefficient*dT/dt - w/time";
  e.source = "Lang, Phys. Today 58-8 (2005) 31; p = 4e-4 C/(m^2 K) of PZT";
  e.residual = "Follows the change of the temperature, not the temperature; returns to the old value by itself.";
  e.needs = "A temperature column that spans 0.5 K or more in less than the leak takes; no voltage amplifier.";
  e.way = Way::insert;
  e.block_type = "pyro_charge";
  e.places = {"command"};
  e.side = Side::temperature;
  e.parameters = {{"coefficient", "unit of the drive per K", "p*A/C of the open electrodes",
                   "up to 3 V/K (1.2 V/K for layers of 50 um)"},
                  {"time", "s", "R_leak*C, or of the charge drive's cut-off",
                   "0.16 .. 16 s (cut-off 1 .. 0.01 Hz), above 1 h for a disconnected stack"}};
  e.look_alikes = {
      {"thermal_expansion", "temperature_staircase", "on a plateau the charge leaks away, an expansion stays"},
      {"creep", "temperature_constant", "creep follows the last step of the drive"},
      {"sensor_drift", "temperature_constant", "a drift does not follow the temperature"}};
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation& at) {
    return fmt::format("{}/K, gone after {}", size_text(values[0], at.unit), time_text(values[1]));
  };
  e.laws = [](const Excitation& at) {
    Law law;
    law.name = "one leak";
    law.block.type = "pyro_charge";
    const double per_kelvin = 0.01 * std::max(at.range(), 1e-30);
    const std::string unit = unit_text(at.unit);
    give(law.block, "coefficient",
         Number{rounded(at.unit.difference_from_si(per_kelvin)), unit.empty() ? "1/K" : unit + "/K"});
    give(law.block, "time", with_unit(at.longest_recording / 30, parse_unit("s")));
    LawParameter coefficient;
    coefficient.path = "coefficient";
    coefficient.is_size = true;
    coefficient.start = per_kelvin;
    if (at.unit.dimension == parse_unit("V").dimension) {
      coefficient.plausible_lower = -3;
      coefficient.plausible_upper = 3;
    }
    LawParameter time;
    time.path = "time";
    time.start = at.longest_recording / 30;
    time.lower = 3 * at.shortest_step;
    // What does not leak within a recording is no more told from an expansion.
    time.upper = std::max(at.longest_recording / 3, 10 * at.shortest_step);
    time.log_scale = true;
    time.scan = per_decade(at.longest_recording / 300, at.longest_recording / 4, 2);
    law.free = {coefficient, time};
    return std::vector<Law>{law};
  };
  e.unseen = [](const Excitation& at) -> std::string {
    if (!at.from_data) return "";
    const double span = at.side_highest - at.side_lowest;
    return span < 0.5 ? fmt::format("the temperature spans {:.2g} K, the charge needs 0.5 K", span) : "";
  };
  return e;
}

}  // namespace hysteron::effects
