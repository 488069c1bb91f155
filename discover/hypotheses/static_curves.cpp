// What asymmetry and sensor_nonlinearity share: a static curve.
#include "discover/hypotheses/static_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "discover/hypotheses/effect_terms.h"

namespace hysteron::effects {
namespace {

/// What the powers of a curve are about: the middle of what the signal does where zero, the rest position, is far from
/// it. A few degrees about 300 K are no powers of a temperature: each would undo what the others do.
std::optional<Number> far_from_zero(const Excitation& at) {
  if (at.range() <= 0 || (at.lowest - at.range() <= 0 && at.highest + at.range() >= 0)) return std::nullopt;
  return level_within(at.range(), 0.5 * (at.lowest + at.highest), at.unit);
}

std::string curve_summary(const Law& law, const std::vector<double>& values, const Excitation& at) {
  std::string text;
  for (std::size_t k = 0; k < values.size() && law.free[k].path.starts_with("coefficients["); ++k) {
    const int power = static_cast<int>(k) + 2;
    if (law.free[k].path != element("coefficients", power)) break;
    text += fmt::format("{}{:.2g} % {}", k == 0 ? "" : ", ", 100 * values[k] / std::max(at.range(), 1e-300),
                        power == 2   ? "quadratic"
                        : power == 3 ? "cubic"
                                     : fmt::format("of order {}", power));
  }
  return text + " over the range";
}

}  // namespace

double neutral_constant(const Excitation& at) {
  const auto middle = far_from_zero(at);
  return middle ? at.unit.to_si(middle->value) : 0;
}

Law curve(const Excitation& at, int order) {
  Law law;
  law.name = order == 2 ? "quadratic" : order == 3 ? "cubic" : fmt::format("of order {}", order);
  law.block.type = "polynomial";
  const double range = at.range() > 0 ? at.range() : 1;
  // The constant is what the powers are about and the linear coefficient is the reference, rounded alike: the neutral
  // curve is u.
  const Number reference = with_unit(range, at.unit), zero = with_unit(0.0, at.unit);
  NumberList coefficients{zero, reference};
  if (const auto middle = far_from_zero(at)) {
    coefficients.front() = {neutral_constant(at), to_text(at.unit.dimension)};
    give(law.block, "about", *middle);
  }
  for (int k = 2; k <= order; ++k) coefficients.push_back(zero);
  give(law.block, "coefficients", std::move(coefficients));
  give(law.block, "reference", reference);
  give(law.block, "lower", level_within(range, at.lowest - range, at.unit));
  give(law.block, "upper", level_within(range, at.highest + range, at.unit));
  for (int k = 2; k <= order; ++k) {
    LawParameter c;
    c.path = element("coefficients", k);
    c.start = 0.01 * range;
    c.lower = -0.5 * range;
    c.upper = 0.5 * range;
    if (order <= 3) {  // of a higher order the powers share what one of them does
      c.plausible_lower = -0.15 * range;
      c.plausible_upper = 0.15 * range;
    } else {
      c.lower *= 8;
      c.upper *= 8;
    }
    law.free.push_back(c);
  }
  if (at.gain_is_free) return law;
  LawParameter slope;
  slope.path = element("coefficients", 1);
  slope.start = range;
  slope.lower = 0.5 * range;
  slope.upper = 1.5 * range;
  law.free.push_back(slope);
  return law;
}

Effect static_curve() {
  Effect e;
  e.way = Way::insert;
  e.block_type = "polynomial";
  e.equation = "y = u + p2*u^2 + p3*u^3";
  e.moves_zero = true;
  e.summary = curve_summary;
  e.unseen = stands_still;
  e.contains = {"calibration"};  // its straight part
  e.parameters = {{"coefficients", "unit of the signal", "of (u/reference)^2 and ^3", ""}};
  e.look_alikes = {{"stiffening", "multisine", "a stiffening spring moves its resonance with the amplitude"},
                   {"saturation", "sine_amplitudes", "a clamp does nothing below its level"}};
  return e;
}

}  // namespace hysteron::effects
