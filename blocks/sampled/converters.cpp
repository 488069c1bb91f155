#include "blocks/sampled/converters.h"

#include <fmt/format.h>

#include <cmath>

#include "blocks/sources/seed.h"

namespace hysteron::blocks {

void SampleHold::describe(BlockSpec<SampleHold>& spec) {
  spec.name("sample_hold", "samples its input and holds it (zero-order hold)").in_group("sampled").elementwise();
  spec.law("y(t) = u(t_k) for t_k <= t < t_(k+1)").from("definition");
  spec.remark("On average it delays the signal by half a period.");
  spec.variation("noise", "sampled_noise", {{"rms", "0"}})
      .variation("computing_time", "delay_line", {{"samples", "0"}});
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.output(&Out<double>::y, "y", "$a", "the held samples");
  spec.sampled(&Params<double>::period, &Params<double>::offset);
}

void Quantizer::describe(BlockSpec<Quantizer>& spec) {
  spec.name("quantizer", "A/D or D/A converter with limited resolution and range")
      .in_group("sampled")
      .elementwise()
      .at("measured");
  spec.law("y = lower + q round((u - lower)/q) within lower ... upper - q, q = (upper - lower)/2^bits")
      .from("Widrow, Kollar, Quantization Noise (2008); two's complement codes");
  spec.remark(
      "Example: 16 bits over +-10 V give steps of 305.2 uV. Zero is a level; the upper end of the range is "
      "not.");
  spec.remark(
      "It samples and holds as well. To quantize only, choose a period shorter than all times of interest, "
      "or use \"rounding\".");
  spec.input(&In<double>::u, "u", "$a", "the signal");
  spec.output(&Out<double>::y, "y", "$a", "the quantized samples, held");
  spec.param(&Params<double>::bits, "bits", "", "resolution: whole number of bits, 1 to 32").minimum = 1;
  spec.param(&Params<double>::lower, "lower", "$a", "lower end of the range");
  spec.param(&Params<double>::upper, "upper", "$a", "upper end of the range");
  spec.sampled(&Params<double>::period, &Params<double>::offset);
}

std::string Quantizer::check(const Params<double>& p) {
  if (std::floor(p.bits) != p.bits || p.bits > 32)
    return fmt::format("{:.4g} bits are not possible; give a whole number from 1 to 32", p.bits);
  if (!(p.lower < p.upper) || !std::isfinite(p.upper - p.lower))
    return "the range {lower} to {upper} has no steps; give a finite lower below a finite upper";
  return "";
}

void SampledNoise::describe(Declaration& d) {
  d.name("sampled_noise", "adds white noise to each sample and holds it")
      .in_group("sampled")
      .elementwise()
      .at("measured");
  d.law("y_k = u(t_k) + rms n_k, n_k standard normal").from("Box, Muller, Ann. Math. Stat. 29 (1958) 610");
  d.remark(
      "Each value depends only on the seed, the name of the block and k: the noise is the same on every "
      "machine and for every solver, and differs between blocks.");
  d.input("u", "$a", "the true signal");
  d.output("y", "$a", "the noisy samples");
  d.parameter("rms", "$a", "root mean square of the noise").linear().not_negative().difference();
  d.parameter("seed", "", "whole number that selects the noise sequence").optional("1").not_negative();
  d.sampled();
}

Sizes SampledNoise::sizes(const Shape&) { return {}; }

std::string SampledNoise::check(const View<double>& v) { return check_seed(v.parameter(seed)); }

Kernel sample_hold_block() { return kernel<SampleHold>(); }
Kernel quantizer_block() { return kernel<Quantizer>(); }
Kernel sampled_noise_block() { return kernel<SampledNoise>(); }

}  // namespace hysteron::blocks
