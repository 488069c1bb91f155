#include "blocks/sources/noise.h"

#include "blocks/sources/seed.h"

namespace hysteron::blocks {

void Noise::describe(Declaration& d) {
  d.name("noise", "random signal of a given bandwidth").in_group("sources");
  d.law(
       "y = offset + rms sum n_k b(t/T - k), n_k standard normal; smooth: b the cubic B-spline over sqrt(151/315), T = "
       "0.2275/bandwidth; hold: b = 1 for 0 <= t/T - k < 1, T = 0.4429/bandwidth")
      .from(
          "de Boor, A Practical Guide to Splines (1978), chapter IX; numbers: Box, Muller, Ann. Math. Stat. 29 (1958)");
  d.remark("At the bandwidth the power density has fallen by half, behind five times of it nothing is left (smooth).");
  d.remark("The same seed gives the same signal on every machine, whatever the solver does.");
  d.remark(
      "Held numbers jump: a law that is driven by the rate of its input (bouc_wen) takes the smooth ones. Noise of a "
      "sensor is \"sensor_noise\", periodic noise with a flat spectrum \"multisine\".");
  d.output("y", "$a", "the signal");
  d.parameter("rms", "$a", "root mean square around the offset").linear().not_negative().difference();
  d.parameter("bandwidth", "Hz", "frequency of half the power density").positive();
  d.parameter("seed", "", "whole number that fixes the numbers").not_negative();
  d.parameter("offset", "$a", "mean value").optional("0").offset();
  d.text("between_numbers", {"smooth", "hold"}, "how it moves from number to number");
}

Sizes Noise::sizes(const Shape& shape) {
  Sizes s;
  s.feedthrough = false;
  if (shape.text("between_numbers") == "hold") s.smoothness = Smoothness::jumps;
  return s;
}

std::string Noise::check(const View<double>& v) { return check_seed(v.parameter(seed)); }

Kernel noise_block() { return kernel<Noise>(); }

}  // namespace hysteron::blocks
