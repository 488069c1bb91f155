// The effect sensor_nonlinearity: a static curve at the sensor.
#include "discover/hypotheses/effect_terms.h"
#include "discover/hypotheses/static_curves.h"

namespace hysteron::effects {
namespace {

/// A sensor that is calibrated over its range is off at zero too: its constant is free where nobody else's zero is.
std::vector<Law> curves_of_sensor(const Excitation& at) {
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

}  // namespace

Effect sensor_nonlinearity() {
  Effect e = static_curve();
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
