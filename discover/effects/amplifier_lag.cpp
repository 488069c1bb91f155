// The effect amplifier_lag: the amplifier follows its command late, with a time constant.
#include "discover/effects/lag.h"
#include "discover/hypotheses/effect_terms.h"

namespace hysteron::effects {

Effect amplifier_lag() {
  Effect e;
  e.id = "amplifier_lag";
  e.title = "Lag of the amplifier";
  e.cause = "The amplifier's bandwidth, and its output resistance into the capacitance of the actuator.";
  e.equation = "tau*dv/dt = u - v (one pole), two such in series (two poles)";
  e.source =
      "Devasia, Eleftheriou, Moheimani, IEEE Trans. Control Syst. Technol. 15 (2007) 802 (bandwidth of the drive)";
  e.residual =
      "In proportion to the rate of the drive at all amplitudes; phase in proportion to frequency, no harmonics.";
  e.needs = "Motion at a twentieth of the corner frequency or faster.";
  e.way = Way::insert;
  e.commutes = Commutes::linear;
  e.block_type = "lag";
  e.places = {"command"};
  e.parameters = {
      {"times", "s", "time constants of the poles",
       "8 us .. 0.5 ms for piezo amplifiers (0.3 .. 20 kHz; PD200 with 10 uF: 7.4 kHz small, 300 Hz large signal)"}};
  e.look_alikes = {{"dead_time", "multisine", "gain drops with the phase of a lag, and stays 1 with a delay"},
                   {"sensor_lag", "monitor", "the drive measured behind the amplifier decides"},
                   {"hysteresis", "high_frequencies", "phase of a lag grows with frequency, that of a loop does not"},
                   {"creep", "step_hold", "a lag settles after a few time constants, creep goes on with log t"}};
  e.family = "lag";
  e.summary = lag_summary;
  e.implausible = lag_without_end;
  e.laws = [](const Excitation& at) {
    auto laws = lag_laws(at);
    // The prior speaks of amplifiers for piezo actuators: volts.
    if (at.unit.dimension == parse_unit("V").dimension)
      for (auto& law : laws) {
        law.free.front().plausible_lower = 8e-6;
        law.free.front().plausible_upper = 5e-4;
      }
    return laws;
  };
  e.unseen = [](const Excitation& at) -> std::string {
    return at.from_data && at.range() <= 0 ? "the drive does not move" : "";
  };
  return e;
}

}  // namespace hysteron::effects
