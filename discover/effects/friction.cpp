// The effects friction and stiffening: what a mass on a spring may lack.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/effects/library.h"

namespace hysteron::effects {
namespace {

/// [m] that the mass moves; a micrometre where nobody looked.
double travel(const Circumstances& at) {
  const double range = at.travel_highest - at.travel_lowest;
  return range > 0 ? range : 1e-6;
}

}  // namespace

Effect friction() {
  Effect e;
  e.id = e.family = "friction";
  e.title = "Friction";
  e.cause = "Guideways, cables, wipers. Flexure stages have none.";
  e.equation = "F = stiffness*z,  z' = v - |v|*z/distance: sticks like a spring, slips at stiffness*distance";
  e.source = "Dahl, AIAA J. 14 (1976) 1675; EFFECTS 3, friction";
  e.residual = "A force error of the sign of the velocity, with spikes where the motion turns.";
  e.needs = "Several reversals, slow and fast ones.";
  e.way = Way::vary;
  e.variation = "presliding";
  e.is_memory = true;
  e.parameters = {{"contact_stiffness", "N/m", "while it sticks", ""},
                  {"slip_distance", "m", "after which it slides", "0.1 .. 50 um"}};
  e.look_alikes = {{"hysteresis", "load_pair", "friction grows with the load and needs a guide"},
                   {"backlash", "triangle", "lost motion is the same at all amplitudes"},
                   {"stiffening", "sine_amplitudes", "a stiffening spring has no memory"}};
  e.summary = [](const Law&, const std::vector<double>& values, const Circumstances& at) {
    return fmt::format("{:.3g} N ({:.2g} % of the force), after {:.3g} um", values[0] * values[1],
                       100 * values[0] * values[1] / std::max(at.range(), 1e-300), values[1] * 1e6);
  };
  e.laws = [](const Circumstances& at) {
    Law law;
    law.name = "presliding (Dahl)";
    law.block.type = "mass_with_presliding";
    const double range = travel(at), force = at.range() > 0 ? at.range() : 1;
    give(law.block, "contact_stiffness", NumberList{with_unit(0.5 * force / range, parse_unit("N/m"))});
    give(law.block, "slip_distance", NumberList{with_unit(0.02 * range, parse_unit("um"))});
    LawParameter k;
    k.path = element("contact_stiffness", 0);
    k.start = 0.5 * force / range;
    k.lower = 1e-5 * force / range;
    k.upper = 1e4 * force / range;
    k.log_scale = true;
    for (const double f : {0.1, 1.0, 10.0}) k.scan.push_back(f * force / range);
    LawParameter d;
    d.path = element("slip_distance", 0);
    d.start = 0.02 * range;
    d.lower = 1e-4 * range;
    d.upper = 10 * range;
    d.log_scale = true;
    for (const double f : {0.003, 0.02, 0.1}) d.scan.push_back(f * range);
    d.plausible_upper = 50e-6;
    law.free = {k, d};
    return std::vector<Law>{law};
  };
  e.unseen = [](const Circumstances& at) -> std::string {
    return at.from_data && at.reversals < 2 ? "the force does not turn twice" : "";
  };
  return e;
}

Effect stiffening() {
  Effect e;
  e.id = e.family = "stiffening";
  e.title = "Stiffening spring";
  e.cause = "Flexures and membranes get harder with travel.";
  e.equation = "F = stiffness*x + stiffening*x^3";
  e.source = "EFFECTS 3, stiffening; Nayfeh, Mook, Nonlinear Oscillations (1979)";
  e.residual = "In proportion to x^3; the resonance moves with the amplitude.";
  e.needs = "Three amplitudes, ideally near the resonance.";
  e.way = Way::vary;
  e.variation = "stiffening";
  e.parameters = {{"stiffening", "N/m^3", "cubic part of the spring",
                   "up to 30 % of the linear force at full travel; negative = softening"}};
  e.look_alikes = {{"sensor_nonlinearity", "multisine", "a sensor's curve cannot move a resonance"},
                   {"asymmetry", "multisine", "a curved drive cannot move a resonance"},
                   {"saturation", "sine_amplitudes", "a clamp does nothing below its level"},
                   {"friction", "sine_amplitudes", "a stiffening spring has no memory"}};
  e.summary = [](const Law&, const std::vector<double>& values, const Circumstances& at) {
    const double x = std::max(std::abs(at.travel_lowest), std::abs(at.travel_highest));
    return fmt::format("{:.3g} N of cubic force at the largest travel", values[0] * x * x * x);
  };
  e.laws = [](const Circumstances& at) {
    Law law;
    law.name = "cubic";
    law.block.type = "mass_on_stiffening_spring";
    const double x = std::max({std::abs(at.travel_lowest), std::abs(at.travel_highest), 1e-12});
    const double unit =
        std::max(at.range(), 1e-30) / (x * x * x);  // as much force as the drive has, at the largest travel
    give(law.block, "stiffening", with_unit(0.01 * unit, parse_unit("N/m^3")));
    LawParameter k3;
    k3.path = "stiffening";
    k3.start = 0.01 * unit;
    k3.lower = -0.3 * unit;
    k3.upper = 10 * unit;
    for (const double f : {-0.05, 0.01, 0.1, 0.5}) k3.scan.push_back(f * unit);
    k3.plausible_upper = unit;
    law.free = {k3};
    return std::vector<Law>{law};
  };
  e.unseen = [](const Circumstances& at) -> std::string {
    return at.from_data && !(at.travel_highest > at.travel_lowest) ? "the mass does not move" : "";
  };
  return e;
}

}  // namespace hysteron::effects
