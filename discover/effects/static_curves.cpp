// The effects asymmetry and sensor_nonlinearity: a static curve before the memory, or at the sensor.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "discover/effects/library.h"

namespace hysteron::effects {
namespace {

/// What the powers of a curve are about: the middle of what the signal does where zero, the rest position, is far from
/// it. A few degrees about 300 K are no powers of a temperature: each would undo what the others do.
std::optional<Number> far_from_zero(const Circumstances& at) {
  if (at.range() <= 0 || (at.lowest - at.range() <= 0 && at.highest + at.range() >= 0)) return std::nullopt;
  return level_within(at.range(), 0.5 * (at.lowest + at.highest), at.unit);
}

/// [SI] The constant of the neutral curve.
double neutral_constant(const Circumstances& at) {
  const auto middle = far_from_zero(at);
  return middle ? at.unit.to_si(middle->value) : 0;
}

/// y = c_0 + c_1 x + c_2 x^2 + ... of the given order, x = (u - about)/range, straight on beyond twice the range. What
/// a curve is bent about is its best straight line (Fleming, section 2), whose slope the user's gain stands for: from
/// the rest position, c_1 is free with it unless a gain behind it is; its constant is the user's zero (moves_zero).
Law curve(const Circumstances& at, int order) {
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

/// A sensor that is calibrated over its range is off at zero too: its constant is free where nobody else's zero is.
std::vector<Law> curves_of_sensor(const Circumstances& at) {
  std::vector<Law> laws;
  for (const int order : {3, 2, 5}) {
    Law law = curve(at, order);
    if (!at.offset_is_free && at.zeros.empty()) {
      LawParameter zero;
      zero.path = element("coefficients", 0);
      zero.start = neutral_constant(at);
      zero.lower = zero.start - 0.5 * at.range();
      zero.upper = zero.start + 0.5 * at.range();
      law.free.push_back(zero);
    }
    laws.push_back(std::move(law));
  }
  return laws;
}

/// The curve before the operators, and other weights of these: what bends the drive bends the loops too.
Law reweighed(const Circumstances& at) {
  Law law = curve(at, 3);
  law.name = "cubic, with other weights of the operators";
  law.reweighs = true;
  return law;
}

std::string curve_summary(const Law& law, const std::vector<double>& values, const Circumstances& at) {
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

Effect common() {
  Effect e;
  e.way = Way::insert;
  e.block_type = "polynomial";
  e.equation = "y = u + p2*u^2 + p3*u^3";
  e.moves_zero = true;
  e.summary = curve_summary;
  e.unseen = stands_still;
  e.parameters = {{"coefficients", "unit of the signal", "of (u/reference)^2 and ^3", ""}};
  e.look_alikes = {{"stiffening", "multisine", "a stiffening spring moves its resonance with the amplitude"},
                   {"saturation", "sine_amplitudes", "a clamp does nothing below its level"}};
  return e;
}

}  // namespace

Effect asymmetry() {
  Effect e = common();
  e.id = e.family = "asymmetry";
  e.title = "Asymmetry";
  e.cause = "Unipolar drive: the low and the high end of the drive, and so both branches, respond differently.";
  e.source = "Gu, Zhu, Su, IEEE Trans. Ind. Electron. 61 (2014) 1583 (cubic input function)";
  e.residual = "Differs between the lower and the upper half of the range; a second harmonic of half the share.";
  e.needs = "Full drive, and small motion about two or more levels.";
  e.places = {"core"};
  e.before_sensor = true;
  e.laws = [](const Circumstances& at) {
    // The cubic first: an S about the middle has nothing quadratic to begin with.
    std::vector<Law> laws{curve(at, 3), curve(at, 2), curve(at, 5)};
    if (!at.weights.empty()) laws.push_back(reweighed(at));
    return laws;
  };
  e.parameters.front().range = "up to 10 % of the linear part";
  e.look_alikes.push_back({"sensor_nonlinearity", "reference_sensor", "a sensor's curve has no memory"});
  return e;
}

Effect sensor_nonlinearity() {
  Effect e = common();
  e.id = e.family = "sensor_nonlinearity";
  e.title = "Curvature of the sensor";
  e.cause = "Tilt and fringes of a capacitive sensor, a bridge, the ends of an LVDT.";
  e.source = "Fleming, Sens. Actuators A 190 (2013) 106 (linearity of position sensors)";
  e.residual = "One curve over the output, the same on rising and falling branches.";
  e.needs = "A second sensor for proof; without it a curve in y or a curved actuator.";
  e.places = {"measured"};
  e.laws = curves_of_sensor;
  e.parameters.front().range = "0.02 .. 1 % of full scale";
  e.look_alikes.push_back({"asymmetry", "reference_sensor", "a sensor's curve has no memory"});
  return e;
}

}  // namespace hysteron::effects
