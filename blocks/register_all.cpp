#include "blocks/register_all.h"

#include "blocks/compensators/bouc_wen_inverse.h"
#include "blocks/compensators/prandtl_ishlinskii_inverse.h"
#include "blocks/continuous/ageing.h"
#include "blocks/continuous/creep.h"
#include "blocks/continuous/dead_time.h"
#include "blocks/continuous/integrator.h"
#include "blocks/continuous/lag.h"
#include "blocks/continuous/load_dependence.h"
#include "blocks/continuous/logarithmic_creep.h"
#include "blocks/continuous/modes.h"
#include "blocks/continuous/pi_controller.h"
#include "blocks/continuous/rate_limiter.h"
#include "blocks/continuous/resonance.h"
#include "blocks/continuous/slew_limit.h"
#include "blocks/continuous/state_space.h"
#include "blocks/continuous/tank.h"
#include "blocks/continuous/thermal_network.h"
#include "blocks/continuous/transfer_function.h"
#include "blocks/disturbances/mains.h"
#include "blocks/disturbances/sensor_drift.h"
#include "blocks/hysteresis/asymmetric_prandtl_ishlinskii.h"
#include "blocks/hysteresis/bouc_wen.h"
#include "blocks/hysteresis/coupled_tapi.h"
#include "blocks/hysteresis/generalized_prandtl_ishlinskii.h"
#include "blocks/hysteresis/jiles_atherton.h"
#include "blocks/hysteresis/late_prandtl_ishlinskii.h"
#include "blocks/hysteresis/maxwell_capacitor.h"
#include "blocks/hysteresis/play.h"
#include "blocks/hysteresis/prandtl_ishlinskii.h"
#include "blocks/hysteresis/preisach.h"
#include "blocks/hysteresis/relay.h"
#include "blocks/hysteresis/tapi.h"
#include "blocks/math/cross_coupling.h"
#include "blocks/math/gain.h"
#include "blocks/math/polynomial.h"
#include "blocks/math/product.h"
#include "blocks/math/rectifier.h"
#include "blocks/math/rounding.h"
#include "blocks/math/saturation.h"
#include "blocks/math/soft_saturation.h"
#include "blocks/math/sum.h"
#include "blocks/measurement/sensor_noise.h"
#include "blocks/measurement/wheatstone_bridge.h"
#include "blocks/mechanics/backlash.h"
#include "blocks/mechanics/guide_friction.h"
#include "blocks/mechanics/mass_on_bouc_wen_spring.h"
#include "blocks/mechanics/mass_on_spring_of_plays.h"
#include "blocks/mechanics/mass_spring_damper.h"
#include "blocks/mechanics/mass_with_friction.h"
#include "blocks/mechanics/mass_with_mode.h"
#include "blocks/mechanics/mass_with_presliding.h"
#include "blocks/mechanics/mass_with_stops.h"
#include "blocks/mechanics/sliding_friction.h"
#include "blocks/sampled/converters.h"
#include "blocks/sampled/delay_line.h"
#include "blocks/sampled/discrete_transfer_function.h"
#include "blocks/sampled/impedance_estimator.h"
#include "blocks/sampled/sampled_pid.h"
#include "blocks/sources/chirp.h"
#include "blocks/sources/constant.h"
#include "blocks/sources/multisine.h"
#include "blocks/sources/recorded.h"
#include "blocks/sources/sine.h"
#include "blocks/sources/staircase.h"
#include "blocks/sources/step.h"
#include "blocks/sources/triangle.h"
#include "blocks/temperature/temperature.h"
#include "blocks/vectors/matrix_gain.h"
#include "blocks/vectors/vectors.h"

namespace hysteron {

Registry all_blocks() {
  Registry r;
  r.add(blocks::constant_block());
  r.add(blocks::sine_block());
  r.add(blocks::triangle_block());
  r.add(blocks::step_block());
  r.add(blocks::staircase_block());
  r.add(blocks::chirp_block());
  r.add(blocks::multisine_block());
  r.add(blocks::recorded_block());
  r.add(blocks::input_block());

  r.add(blocks::gain_block());
  r.add(blocks::sum_block());
  r.add(blocks::product_block());
  r.add(blocks::pass_block());
  r.add(blocks::saturation_block());
  r.add(blocks::soft_saturation_block());
  r.add(blocks::polynomial_block());
  r.add(blocks::calibration_block());
  r.add(blocks::cross_coupling_block());
  r.add(blocks::late_cross_coupling_block());
  r.add(blocks::temperature_gain_block());
  r.add(blocks::thermal_expansion_block());
  r.add(blocks::pyro_charge_block());
  r.add(blocks::ageing_block());
  r.add(blocks::load_dependence_block());
  r.add(blocks::sensor_drift_block());
  r.add(blocks::rectifier_block());
  r.add(blocks::rounding_block());
  r.add(blocks::mains_interference_block());

  r.add(blocks::mux_block());
  r.add(blocks::demux_block());
  r.add(blocks::select_block());
  r.add(blocks::matrix_gain_block());

  r.add(blocks::integrator_block());
  r.add(blocks::transfer_function_block());
  r.add(blocks::state_space_block());
  r.add(blocks::pi_controller_block());
  r.add(blocks::resonance_block());
  r.add(blocks::modes_block());
  r.add(blocks::lag_block());
  r.add(blocks::creep_block());
  r.add(blocks::logarithmic_creep_block());
  r.add(blocks::dead_time_block());
  r.add(blocks::rate_limiter_block());
  r.add(blocks::slew_limit_block());
  r.add(blocks::current_limit_block());
  r.add(blocks::tank_block());
  r.add(blocks::thermal_network_block());

  r.add(blocks::play_block());
  r.add(blocks::prandtl_ishlinskii_block());
  r.add(blocks::generalized_prandtl_ishlinskii_block());
  r.add(blocks::late_prandtl_ishlinskii_block());
  r.add(blocks::preisach_block());
  r.add(blocks::bouc_wen_block());
  r.add(blocks::jiles_atherton_block());
  r.add(blocks::asymmetric_prandtl_ishlinskii_block());
  r.add(blocks::tapi_block());
  r.add(blocks::coupled_tapi_block());
  r.add(blocks::maxwell_capacitor_block());
  r.add(blocks::relay_block());

  r.add(blocks::prandtl_ishlinskii_inverse_block());
  r.add(blocks::bouc_wen_inverse_block());
  r.add(blocks::jiles_atherton_inverse_block());

  r.add(blocks::mass_spring_damper_block());
  r.add(blocks::mass_on_stiffening_spring_block());
  r.add(blocks::mass_with_drag_block());
  r.add(blocks::mass_with_friction_block());
  r.add(blocks::mass_with_mode_block());
  r.add(blocks::mass_with_presliding_block());
  r.add(blocks::sliding_friction_block());
  r.add(blocks::guide_friction_block());
  r.add(blocks::mass_on_hysteretic_spring_block());
  r.add(blocks::mass_on_spring_of_plays_block());
  r.add(blocks::mass_on_bouc_wen_spring_block());
  r.add(blocks::mass_with_stops_block());
  r.add(blocks::backlash_block());

  r.add(blocks::sample_hold_block());
  r.add(blocks::quantizer_block());
  r.add(blocks::sampled_noise_block());
  r.add(blocks::delay_line_block());
  r.add(blocks::discrete_transfer_function_block());
  r.add(blocks::sampled_pid_block());
  r.add(blocks::sampled_bouc_wen_inverse_block());
  r.add(blocks::sampled_jiles_atherton_inverse_block());
  r.add(blocks::sampled_asymmetric_inverse_block());
  r.add(blocks::sampled_tapi_inverse_block());
  r.add(blocks::sampled_coupled_tapi_inverse_block());
  r.add(blocks::impedance_estimator_block());

  r.add(blocks::wheatstone_bridge_block());
  r.add(blocks::wheatstone_bridge_inverse_block());
  r.add(blocks::sensor_noise_block());
  return r;
}

}  // namespace hysteron
