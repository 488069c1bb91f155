// The effect quadratic_drag: what a fluid holds back of a mass that moves fast.
#include <fmt/format.h>

#include <algorithm>

#include "discover/hypotheses/effect_terms.h"
#include "discover/hypotheses/travel.h"

namespace hysteron::effects {

Effect quadratic_drag() {
  Effect e;
  e.id = e.family = "quadratic_drag";
  e.title = "Drag of a fluid";
  e.cause = "A body that moves fast through air or liquid, a flow through an orifice.";
  e.equation = "F = drag*v*|v|";
  e.source = "Batchelor, An Introduction to Fluid Dynamics (1967), section 5.11";
  e.residual = "In proportion to v*|v|: odd harmonics only, the third a fifth of the first.";
  e.needs = "Speeds that span 3:1.";
  e.way = Way::vary;
  e.variation = "drag";
  e.parameters = {{"drag", "N s^2/m^2, N m s^2/rad^2", "over the square of the speed", "rho*A*C_d/2, never negative"}};
  e.look_alikes = {{"friction", "triangle", "friction does not grow with the speed"},
                   {"stiffening", "low_frequencies", "a spring acts at rest too"}};
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation& at) {
    return fmt::format("{:.3g} {}", values[0], turns(at) ? "N m at 1 rad/s" : "N at 1 m/s");
  };
  e.laws = [](const Excitation& at) {
    Law law;
    law.name = "square of the speed";
    law.block.type = at.by.empty() ? "mass_with_drag" : at.by;
    // As much force as the drive has, at the whole travel in ten rows.
    const double speed = travel(at) / std::max(10 * at.shortest_step, 1e-9);
    const double unit = std::max(at.range(), 1e-30) / (speed * speed);
    give(law.block, "drag", with_unit(0.01 * unit, parse_unit(turns(at) ? "N*m*s^2/rad^2" : "N*s^2/m^2")));
    LawParameter c;
    c.path = "drag";
    c.is_size = true;
    c.start = 0.01 * unit;
    c.lower = 1e-9 * unit;
    c.upper = 1e9 * unit;
    c.log_scale = true;
    c.scan = per_decade(1e-3 * unit, 1e6 * unit, 2);
    law.free = {c};
    return std::vector<Law>{law};
  };
  e.unsure = [](const Excitation& at) { return one_speed(at, 3, "tell it from a damper"); };
  e.unseen = [](const Excitation& at) { return stands(at, turns(at) ? "the inertia" : "the mass"); };
  return e;
}

}  // namespace hysteron::effects
