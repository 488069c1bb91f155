// Decides which effects there are: one file and one line each. Internal to discover.
#pragma once

#include "discover/hypotheses/effect.h"
#include "engine/diagram/time_text.h"

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
std::vector<Law> lag_laws(const Circumstances& at);
std::string lag_summary(const Law& law, const std::vector<double>& values, const Circumstances& at);
/// Why a lag of these time constants is none: slower than all recordings, it integrates. "" = it is one.
std::string lag_without_end(const Law& law, const std::vector<double>& values, const Circumstances& at);
/// Gives a block a parameter.
void give(Node& block, const std::string& parameter, Value value);
/// Values from `from` to `to`, `per_decade` of them in each decade, rounded to three digits so that a file stays
/// readable.
std::vector<double> per_decade(double from, double to, double per_decade);
/// `value` rounded to three significant digits.
double rounded(double value);
/// A rate [SI per second] of a signal in `unit`, as a parameter.
Number per_second(double si, const Unit& unit);
using hysteron::time_text;
/// What the law's block has written; nullptr if nothing, or something else.
template <class T>
const T* written(const Law& law, const char* parameter) {
  const Value* value = law.block.parameters.find(parameter);
  return value != nullptr ? std::get_if<T>(&value->content) : nullptr;
}
/// A unit as it is written into a file: as people wrote it, else its dimension.
std::string unit_text(const Unit& unit);
/// A level [SI], not a difference, as a parameter in `unit`: 20 degC stays 20 degC.
Number level(double si, const Unit& unit);
/// The same, rounded to a few hundredths of the `range` [SI, > 0] that the signal has, however far that is from zero.
Number level_within(double range, double si, const Unit& unit);
/// [K] A room in which a device is usually calibrated, 20 .. 25 degC: of it what is nearest to `temperature`.
double usual_room(double temperature);
/// Part of the stroke behind which a clearance or a guide's friction has followed; domains switch over all of it.
inline constexpr double short_way = 0.1;
/// Why swings of fewer than three sizes show an effect only in part (`what` they leave open); "" where there are more.
std::string few_sizes(const Circumstances& at, const char* what);
/// Why swings whose speeds differ less than `ratio` times do; `what` they leave open.
std::string one_speed(const Circumstances& at, double ratio, const char* what);
/// Why nothing can be seen at a place where the signal does not move, "" where it does or nobody looked.
std::string stands_still(const Circumstances& at);

}  // namespace hysteron::effects
