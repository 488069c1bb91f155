// The effect stiffening: a spring that gets harder, or softer, with travel.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discover/hypotheses/effect_terms.h"
#include "discover/hypotheses/travel.h"

namespace hysteron::effects {

namespace {

/// A resonance that is no mass: what drives it, and what it answers, are of one unit, and its spring without one.
bool is_of_one_unit(const Excitation& at) { return at.by == "duffing"; }

/// Of the number that is written for this power of the motion.
Unit unit_of(const Excitation& at, int power) {
  if (!is_of_one_unit(at)) return parse_unit(fmt::format("N/m^{}", power));
  const std::string own = unit_text(at.unit);
  return own.empty() || own == "1" ? Unit{} : parse_unit(fmt::format("1/({})^{}", own, power - 1));
}

}  // namespace

Effect stiffening() {
  Effect e;
  e.id = e.family = "stiffening";
  e.title = "Stiffening spring";
  e.cause = "Flexures and membranes get harder with travel, coils and capacitors with their current and voltage.";
  e.equation = "F = stiffness*x + stiffening*x^3";
  e.source = "Nayfeh, Mook, Nonlinear Oscillations (1979)";
  e.residual = "In proportion to x^3; the resonance moves with the amplitude.";
  e.needs = "Three amplitudes, ideally near the resonance.";
  e.way = Way::vary;
  e.variation = "stiffening";
  e.parameters = {{"stiffening", "N/m^3; 1/unit^2 in a resonance", "cubic part of the spring",
                   "up to 30 % of the linear force at full travel; negative = softening"}};
  e.look_alikes = {{"sensor_nonlinearity", "multisine", "a sensor's curve cannot move a resonance"},
                   {"asymmetry", "multisine", "a curved drive cannot move a resonance"},
                   {"saturation", "sine_amplitudes", "a clamp does nothing below its level"},
                   {"friction", "sine_amplitudes", "a stiffening spring has no memory"}};
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation& at) {
    const double x = std::max(std::abs(at.travel_lowest), std::abs(at.travel_highest));
    if (is_of_one_unit(at))
      return fmt::format("at the largest motion the spring pulls {:.2g} % {} than in proportion",
                         std::abs(100 * values[0] * x * x), values[0] < 0 ? "less" : "more");
    return fmt::format("{:.3g} N of cubic force at the largest travel", values[0] * x * x * x);
  };
  e.laws = [](const Excitation& at) {
    Law law;
    law.name = "cubic";
    law.block.type = at.by.empty() ? "mass_on_stiffening_spring" : at.by;
    const double reach = std::max(std::abs(at.travel_lowest), std::abs(at.travel_highest));
    const double x = reach > 0 ? reach : travel(at);
    // As much as the drive has at the largest travel, or, where the spring is 1, as this itself pulls there.
    const double unit = is_of_one_unit(at) ? 1 / (x * x) : std::max(at.range(), 1e-30) / (x * x * x);
    give(law.block, "stiffening", with_unit(0.01 * unit, unit_of(at, 3)));
    LawParameter k3;
    k3.path = "stiffening";
    k3.is_size = true;
    k3.start = 0.01 * unit;
    k3.lower = -0.3 * unit;
    k3.upper = 10 * unit;
    for (const double f : {-0.05, 0.01, 0.1, 0.5}) k3.scan.push_back(f * unit);
    k3.plausible_upper = unit;
    law.free = {k3};

    // Harder one way than the other, and harder still at large travel; as much force at the largest travel each.
    Law more = law;
    more.name = "quadratic, cubic and quintic";
    const auto further = [&](const char* path, double size, int power) {
      give(more.block, path, with_unit(0.0, unit_of(at, power)));
      LawParameter p;
      p.path = path;
      p.lower = -3 * size;
      p.upper = 3 * size;
      p.scan = {-0.1 * size, 0.1 * size};
      more.free.push_back(p);
    };
    further("quadratic", unit * x, 2);
    further("quintic", unit / (x * x), 5);
    return std::vector<Law>{law, more};
  };
  e.unsure = [](const Excitation& at) { return few_sizes(at, "tell it from a wrong stiffness"); };
  e.unseen = [](const Excitation& at) { return stands(at, "the mass"); };
  return e;
}

}  // namespace hysteron::effects
