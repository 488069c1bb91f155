// The effect sensor_lag: the sensor follows what it measures late, with a time constant.
#include "discover/effects/lag.h"
#include "discover/hypotheses/effect_terms.h"

namespace hysteron::effects {

Effect sensor_lag() {
  Effect e;
  e.id = "sensor_lag";
  e.title = "Lag of the sensor";
  e.cause = "The sensor's bandwidth, or the time that heat needs to reach it.";
  e.equation = "tau*dy/dt = x - y (one pole), two such in series (two poles)";
  e.source = "Fleming, Sens. Actuators A 190 (2013) 106 (bandwidth of position sensors)";
  e.residual = "In proportion to the rate of the output, at all amplitudes.";
  e.needs = "Motion at a twentieth of the corner frequency or faster.";
  e.way = Way::insert;
  e.commutes = Commutes::linear;
  e.block_type = "lag";
  e.places = {"measured"};
  e.parameters = {
      {"times", "s", "time constants of the poles",
       "2 us .. 16 ms for position sensors (10 Hz .. 100 kHz, Fleming 2013); seconds to minutes for temperature"}};
  e.look_alikes = {{"dead_time", "multisine", "gain drops with the phase of a lag, and stays 1 with a delay"},
                   {"amplifier_lag", "monitor", "the drive measured behind the amplifier decides"},
                   {"hysteresis", "high_frequencies", "phase of a lag grows with frequency, that of a loop does not"},
                   {"creep", "step_hold", "a lag settles after a few time constants, creep goes on with log t"}};
  e.family = "lag";
  e.summary = lag_summary;
  e.implausible = lag_without_end;
  e.laws = [](const Excitation& at) {
    auto laws = lag_laws(at);
    if (at.unit.dimension == parse_unit("m").dimension)
      for (auto& law : laws) {
        law.free.front().plausible_lower = 1.6e-6;
        law.free.front().plausible_upper = 1.6e-2;
      }
    return laws;
  };
  e.unseen = [](const Excitation& at) -> std::string {
    return at.from_data && at.range() <= 0 ? "the output does not move" : "";
  };
  return e;
}

}  // namespace hysteron::effects
