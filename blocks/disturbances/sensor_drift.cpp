#include "blocks/disturbances/sensor_drift.h"

namespace hysteron::blocks {

void SensorDrift::describe(Declaration& d) {
  d.name("sensor_drift", "adds a sensor offset that drifts linearly with time")
      .in_group("disturbances")
      .elementwise()
      .at("measured");
  d.law("y = u + zero + rate t")
      .from("definition; Fleming, Sens. Actuators A 190 (2013) 106-126 (drift of position sensors)");
  d.remark("The drift differs between recordings: a fit estimates it per recording.");
  d.input("u", "$a", "the signal");
  d.output("y", "$a", "the sensor reading");
  d.parameter("rate", "$a/s", "drift per second").offset().difference();
  d.parameter("zero", "$a", "offset at t = 0 of the recording").optional("0").offset().difference();
}

Kernel sensor_drift_block() { return kernel<SensorDrift>(); }

}  // namespace hysteron::blocks
