// The effect calibration: the sensor's gain or zero is not what the model says.
#include <fmt/format.h>

#include <cmath>

#include "discover/hypotheses/effect_terms.h"

namespace hysteron::effects {

Effect calibration() {
  Effect e;
  e.id = "calibration";
  e.title = "Calibration of the sensor";
  e.cause = "The sensor's sensitivity or zero differs from the value in the model, or a unit was mistaken.";
  e.equation = "y = gain*x + offset";
  e.source = "Tan, Clevy, Laurent, Chaillet, calibration of nanopositioning stages, Micromachines 6 (2015)";
  e.residual = "A straight line of the residual against the output, the same at all frequencies and amplitudes.";
  e.needs = "Nothing. Always tried first.";
  e.way = Way::insert;
  e.block_type = "calibration";
  e.places = {"measured"};
  e.parameters = {
      {"gain", "", "measured over true change", "0.98 .. 1.02 usually; 1000, 0.1, 2 pi or sqrt(2) is a mistaken unit"},
      {"offset", "unit of the output", "reading at zero", "any"}};
  e.look_alikes = {};
  e.family = "calibration";
  e.straight = true;
  e.summary = [](const Law& law, const std::vector<double>& values, const Excitation& at) {
    std::string text;
    for (std::size_t i = 0; i < law.free.size(); ++i) {
      const bool gain = law.free[i].path == "gain";
      text += (text.empty() ? "" : ", ") +
              (gain ? fmt::format("gain {:.5g}", values[i])
                    : fmt::format("offset {:.4g} {}", at.unit.difference_from_si(values[i]), at.unit.text));
      // A factor of these sizes is no tired sensor but a mistaken unit.
      for (const auto& [factor, name] : {std::pair{1000.0, "1000"},
                                         {1e6, "1e6"},
                                         {0.1, "0.1"},
                                         {1e-3, "0.001"},
                                         {10.0, "10"},
                                         {6.283185307, "2 pi"},
                                         {1.414213562, "sqrt(2)"},
                                         {0.7071067812, "1/sqrt(2)"},
                                         {-1.0, "-1"}})
        if (gain && std::abs(values[i] / factor - 1) < 0.02)
          text += fmt::format(" (a factor of {} is often a mistaken unit)", name);
    }
    return text;
  };
  e.laws = [](const Excitation& at) {
    Law law;
    law.name = at.gain_is_free ? "offset" : at.offset_is_free ? "gain" : "gain and offset";
    law.block.type = "calibration";
    give(law.block, "gain", 1.0);
    give(law.block, "offset", with_unit(0.0, at.unit));
    if (!at.gain_is_free) {
      LawParameter gain;
      gain.path = "gain";
      gain.start = 1;
      gain.plausible_lower = 0.95;  // five times the usual 2 %, so that only a real surprise is flagged
      gain.plausible_upper = 1.05;
      law.free.push_back(gain);
    }
    if (!at.offset_is_free) {
      LawParameter offset;
      offset.path = "offset";
      law.free.push_back(offset);
    }
    std::vector<Law> laws{law};
    if (law.free.size() == 2) {
      law.name = "offset";
      law.free.erase(law.free.begin());
      laws.push_back(law);
    }
    return laws;
  };
  e.unseen = [](const Excitation& at) -> std::string {
    if (at.gain_is_free && at.offset_is_free) return "gain and offset are free in the diagram already";
    if (at.from_data && !at.gain_is_free && !at.offset_is_free && at.range() <= 0)
      return "the signal does not move, so gain and offset cannot be told apart";
    return "";
  };
  return e;
}

}  // namespace hysteron::effects
