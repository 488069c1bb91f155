#include "blocks/register_all.h"

#include "blocks/ageing.h"
#include "blocks/asymmetric_prandtl_ishlinskii.h"
#include "blocks/backlash.h"
#include "blocks/bouc_wen.h"
#include "blocks/bouc_wen_inverse.h"
#include "blocks/chirp.h"
#include "blocks/constant.h"
#include "blocks/converters.h"
#include "blocks/coupled_tapi.h"
#include "blocks/creep.h"
#include "blocks/cross_coupling.h"
#include "blocks/dead_time.h"
#include "blocks/delay_line.h"
#include "blocks/discrete_transfer_function.h"
#include "blocks/gain.h"
#include "blocks/generalized_prandtl_ishlinskii.h"
#include "blocks/guide_friction.h"
#include "blocks/impedance_estimator.h"
#include "blocks/integrator.h"
#include "blocks/jiles_atherton.h"
#include "blocks/lag.h"
#include "blocks/late_prandtl_ishlinskii.h"
#include "blocks/load_dependence.h"
#include "blocks/logarithmic_creep.h"
#include "blocks/mains.h"
#include "blocks/mass_on_bouc_wen_spring.h"
#include "blocks/mass_on_spring_of_plays.h"
#include "blocks/mass_spring_damper.h"
#include "blocks/mass_with_friction.h"
#include "blocks/mass_with_mode.h"
#include "blocks/mass_with_presliding.h"
#include "blocks/mass_with_stops.h"
#include "blocks/matrix_gain.h"
#include "blocks/maxwell_capacitor.h"
#include "blocks/modes.h"
#include "blocks/multisine.h"
#include "blocks/pi_controller.h"
#include "blocks/play.h"
#include "blocks/polynomial.h"
#include "blocks/prandtl_ishlinskii.h"
#include "blocks/prandtl_ishlinskii_inverse.h"
#include "blocks/preisach.h"
#include "blocks/product.h"
#include "blocks/rate_limiter.h"
#include "blocks/recorded.h"
#include "blocks/rectifier.h"
#include "blocks/relay.h"
#include "blocks/resonance.h"
#include "blocks/rounding.h"
#include "blocks/sampled_pid.h"
#include "blocks/saturation.h"
#include "blocks/sensor_drift.h"
#include "blocks/sensor_noise.h"
#include "blocks/sine.h"
#include "blocks/slew_limit.h"
#include "blocks/sliding_friction.h"
#include "blocks/soft_saturation.h"
#include "blocks/staircase.h"
#include "blocks/state_space.h"
#include "blocks/step.h"
#include "blocks/sum.h"
#include "blocks/tank.h"
#include "blocks/tapi.h"
#include "blocks/temperature.h"
#include "blocks/thermal_network.h"
#include "blocks/transfer_function.h"
#include "blocks/triangle.h"
#include "blocks/vectors.h"
#include "blocks/wheatstone_bridge.h"

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
