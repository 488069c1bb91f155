// The effect sensor_drift: the reading runs away though nothing moves.
#include <fmt/format.h>

#include "discover/hypotheses/effect_terms.h"
#include "fit/signals/unit_words.h"

namespace hysteron::effects {

Effect sensor_drift() {
  Effect e;
  e.id = e.family = "sensor_drift";
  e.title = "Drift of the sensor";
  e.cause = "Electronics that warm up, humidity, ageing of the sensor.";
  e.equation = "y = u + zero + rate*t, of its own in each recording";
  e.source = "Fleming, Sens. Actuators A 190 (2013) 106";
  e.residual = "Grows with time at constant drive and temperature.";
  e.needs = "A recording of ten minutes or more; a temperature, to tell it from expansion.";
  e.way = Way::insert;
  e.block_type = "sensor_drift";
  e.places = {"measured"};
  e.moves_zero = false;
  e.parameters = {{"rate", "unit of the output per s", "per recording", "1 .. 100 nm/h for capacitive sensors"},
                  {"zero", "unit of the output", "per recording", "any"}};
  e.look_alikes = {{"thermal_expansion", "temperature_constant", "a drift does not follow the temperature"},
                   {"creep", "zero_run", "creep follows the last move"}};
  e.summary = [](const Law&, const std::vector<double>& values, const Excitation& at) {
    return fmt::format("{}/h in the last recording", size_text(3600 * values[0], at.unit));
  };
  e.laws = [](const Excitation& at) {
    Law law;
    law.name = "steady";
    law.block.type = "sensor_drift";
    give(law.block, "rate", per_second(0, at.unit));
    give(law.block, "zero", with_unit(0.0, at.unit));
    LawParameter rate;
    rate.path = "rate";
    rate.per_recording = true;
    law.free = {rate};
    Law more = law;
    more.name = "steady, from a zero of its own";
    LawParameter zero;
    zero.path = "zero";
    zero.per_recording = true;
    more.free.push_back(zero);
    return std::vector<Law>{law, more};
  };
  e.seen_by_degrees = true;
  e.unseen = [](const Excitation& at) -> std::string {
    if (!at.from_data || at.longest_recording >= 600) return "";
    return fmt::format("the longest recording lasts {}, a drift needs 10 min", time_text(at.longest_recording));
  };
  return e;
}

}  // namespace hysteron::effects
