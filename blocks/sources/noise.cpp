#include "blocks/sources/noise.h"

#include "blocks/sources/seed.h"

namespace hysteron::blocks {

void Noise::describe(Declaration& d) {
  d.name("noise", "band-limited Gaussian noise").in_group("sources");
  d.law(
       "y = offset + rms sum n_k b(t/T - k), n_k standard normal; smooth: b the cubic B-spline over sqrt(151/315), T = "
       "0.2275/bandwidth; hold: b = 1 for 0 <= t/T - k < 1, T = 0.4429/bandwidth")
      .from(
          "de Boor, A Practical Guide to Splines (1978), chapter IX; numbers: Box, Muller, Ann. Math. Stat. 29 (1958)");
  d.remark(
      "At the bandwidth the power spectral density has fallen by half (-3 dB); with \"smooth\" it is "
      "negligible above five times the bandwidth.");
  d.remark("The same seed gives the same signal on every machine and for every solver.");
  d.remark(
      "With \"hold\" the output jumps: for a block that is driven by the rate of its input (e.g. bouc_wen) "
      "use \"smooth\". For sensor noise use \"sensor_noise\", for a periodic signal with a flat spectrum "
      "\"multisine\".");
  d.output("y", "$a", "the signal");
  d.parameter("rms", "$a", "root mean square (rms) of the signal around the offset")
      .linear()
      .not_negative()
      .difference();
  d.parameter("bandwidth", "Hz", "bandwidth: frequency of half the power spectral density (-3 dB)").positive();
  d.parameter("seed", "", "whole number that selects the noise sequence").not_negative();
  d.parameter("offset", "$a", "mean value").optional("0").offset();
  d.text("between_numbers", {"smooth", "hold"}, "between the random values: smooth (cubic B-spline) or held");
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
