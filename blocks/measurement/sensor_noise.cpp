#include "blocks/measurement/sensor_noise.h"

#include "blocks/sources/seed.h"

namespace hysteron::blocks {

void SensorNoise::describe(Declaration& d) {
  d.name("sensor_noise", "adds white noise, a new random value every period").in_group("measurement").at("measured");
  d.law("y = u + rms n_k, k = floor(t/period), n_k standard normal")
      .from("Box, Muller, Ann. Math. Stat. 29 (1958) 610");
  d.remark(
      "Each value depends only on the seed, the name of the block and k: the noise is the same on every "
      "machine and for every solver, and differs between blocks.");
  d.remark("Set the period to the sampling time of the sensor. The output jumps: it has no rate.");
  d.input("u", "$a", "the true signal");
  d.output("y", "$a", "the noisy signal");
  d.parameter("rms", "$a", "root mean square of the noise").linear().not_negative().difference();
  d.parameter("period", "s", "time between two values").positive();
  d.parameter("seed", "", "whole number that selects the noise sequence").optional("1").not_negative();
}

Sizes SensorNoise::sizes(const Shape&) {
  Sizes s;
  s.smoothness = Smoothness::no_rate;
  return s;
}

std::string SensorNoise::check(const View<double>& v) { return check_seed(v.parameter(seed)); }

Kernel sensor_noise_block() { return kernel<SensorNoise>(); }

}  // namespace hysteron::blocks
