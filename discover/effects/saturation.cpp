// The effect saturation: beyond a level the signal stays where it is.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/hypotheses/effect_terms.h"

namespace hysteron::effects {

Effect saturation() {
  Effect e;
  e.id = "saturation";
  e.title = "Saturation";
  e.cause = "Limits of a supply, a converter, a servo's output or a sensor's range.";
  e.equation = "y = max(lower, min(upper, u)), or with a knee u/(1 + |u/limit|^n)^(1/n)";
  e.source = "Rapp, ESA SP-332 (1991) 179 (knee); PI E-617 manual (limits of a piezo amplifier)";
  e.residual = "Nothing until a level is passed, then all that goes beyond it: flat tops.";
  e.needs = "At least 3 % of the rows beyond the limit.";
  e.way = Way::insert;
  e.block_type = "saturation";
  e.places = {"command", "measured"};
  e.parameters = {{"lower", "unit of the signal", "smallest value that passes", "-30 .. -20 V for piezo amplifiers"},
                  {"upper", "unit of the signal", "largest value that passes", "100 .. 150 V for piezo amplifiers"}};
  e.look_alikes = {{"slew_limit", "sine_amplitudes", "a clamp has a level, a slew limit a rate"},
                   {"asymmetry", "sine_amplitudes", "a clamp does nothing below its level"},
                   {"sensor_nonlinearity", "reference_sensor", "a clamp does nothing below its level"}};
  e.family = "saturation";
  e.summary = [](const Law& law, const std::vector<double>& values, const Excitation& at) {
    if (law.block.type == "soft_saturation")
      return fmt::format("at {:.4g} {}, sharpness {:.2g}", at.unit.difference_from_si(values[0]), at.unit.text,
                         values[1]);
    const auto shown = [&](double si) { return fmt::format("{:.4g}", at.unit.from_si(si)); };
    const double rounding = 1e-6 * at.range();
    const bool low = values[0] > at.lowest + rounding, high = values[1] < at.highest - rounding;
    return low && high ? fmt::format("between {} and {} {}", shown(values[0]), shown(values[1]), at.unit.text)
           : low       ? fmt::format("below {} {}", shown(values[0]), at.unit.text)
                       : fmt::format("above {} {}", shown(values[1]), at.unit.text);
  };
  e.laws = [](const Excitation& at) {
    Law law;
    law.name = "hard limits";
    law.block.type = "saturation";
    const double range = at.range() > 0 ? at.range() : 1;
    give(law.block, "lower", level(at.lowest, at.unit));
    give(law.block, "upper", level(at.highest, at.unit));
    // A limit at the end of the range of all recordings limits nothing: held at that bound it costs no parameter.
    LawParameter lower;
    lower.path = "lower";
    lower.start = lower.lower = at.lowest;
    lower.upper = at.lowest + 0.49 * range;
    LawParameter upper;
    upper.path = "upper";
    upper.start = upper.upper = at.highest;
    upper.lower = at.lowest + 0.51 * range;
    // First of all none.
    lower.scan = {at.lowest};
    upper.scan = {at.highest};
    for (const double share : {0.0, 0.03, 0.1, 0.2, 0.35}) {
      lower.scan.push_back(at.lowest + share * range);
      upper.scan.push_back(at.highest - share * range);
    }
    law.free = {lower, upper};

    Law knee;
    knee.name = "soft knee";
    knee.apart = true;  // far below a knee nothing is flat, and limits that are hard bring nothing
    knee.block.type = "soft_saturation";
    const double size = std::max({std::abs(at.lowest), std::abs(at.highest), 1e-30});
    give(knee.block, "limit", with_unit(2 * size, at.unit));
    give(knee.block, "sharpness", 4.0);
    LawParameter limit;
    limit.path = "limit";
    limit.start = 2 * size;
    limit.lower = 0.3 * size;
    limit.upper = 1e3 * size;  // as good as none
    limit.log_scale = true;
    for (const double f : {0.7, 1.0, 1.4, 3.0}) limit.scan.push_back(f * size);
    LawParameter sharpness;
    sharpness.path = "sharpness";
    sharpness.start = 4;
    sharpness.lower = 1;
    sharpness.upper = 100;
    sharpness.log_scale = true;
    sharpness.scan = {2, 4, 12};
    knee.free = {limit, sharpness};
    return std::vector<Law>{law, knee};
  };
  e.unseen = stands_still;
  return e;
}

}  // namespace hysteron::effects
