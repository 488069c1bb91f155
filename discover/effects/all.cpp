// To add an effect: its file in this folder, its line in library.h, its line here.
#include "discover/effects/all.h"

#include "discover/effects/library.h"

namespace hysteron {

Effects all_effects() {
  using namespace effects;
  return Effects({
      calibration(),
      drive_gain(),
      initial_remanence(),
      hysteresis(),
      creep(),
      amplifier_lag(),
      sensor_lag(),
      dead_time(),
      slew_limit(),
      structural_resonance(),
      saturation(),
      backlash(),
      asymmetry(),
      sensor_nonlinearity(),
      temperature_gain(),
      thermal_expansion(),
      cross_coupling(),
      rate_dependence(),
      ageing(),
      mains_interference(),
      load_dependence(),
      sensor_drift(),
      rectification(),
      friction(),
      stribeck_friction(),
      quadratic_drag(),
      stiffening(),
      quantization(),
      pyro_charge_drift(),
      sqrt_outflow(),
      overflow(),
  });
}

}  // namespace hysteron
