// Decides which effects there are: one file and one line each. Internal to discover.
#pragma once

#include "discover/hypotheses/effect.h"
#include "discover/hypotheses/effect_terms.h"

namespace hysteron::effects {

Effect calibration();
Effect drive_gain();
Effect initial_remanence();
Effect hysteresis();
Effect creep();
Effect amplifier_lag();
Effect sensor_lag();
Effect dead_time();
Effect slew_limit();
Effect structural_resonance();
Effect saturation();
Effect backlash();
Effect asymmetry();
Effect sensor_nonlinearity();
Effect temperature_gain();
Effect thermal_expansion();
Effect cross_coupling();
Effect friction();
Effect stribeck_friction();
Effect quadratic_drag();
Effect load_dependence();
Effect sensor_drift();
Effect rectification();
Effect rate_dependence();
Effect ageing();
Effect mains_interference();
Effect stiffening();
Effect quantization();
Effect pyro_charge_drift();
Effect sqrt_outflow();
Effect overflow();

/// The laws that amplifier and sensor lag share: one pole, two poles.
std::vector<Law> lag_laws(const Excitation& at);
std::string lag_summary(const Law& law, const std::vector<double>& values, const Excitation& at);
/// Why a lag of these time constants is none: slower than all recordings, it integrates. "" = it is one.
std::string lag_without_end(const Law& law, const std::vector<double>& values, const Excitation& at);
/// [K] A room in which a device is usually calibrated, 20 .. 25 degC: of it what is nearest to `temperature`.
double usual_room(double temperature);

}  // namespace hysteron::effects
