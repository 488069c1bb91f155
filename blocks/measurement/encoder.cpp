#include "blocks/measurement/encoder.h"

namespace hysteron::blocks {
namespace {

template <class B>
void describe_counting(BlockSpec<B>& d, const std::string& unit, const std::string& scale,
                       const std::string& scale_unit, const std::string& what, const std::string& error) {
  using P = Counting::Params<double>;
  d.in_group("measurement").elementwise().at("measured");
  d.law(
       "y = q round((u + e(u))/q), q = pitch/divisions, e(u) = error_cosine cos(2 pi u/pitch) + error_sine sin(2 pi u/pitch) + "
       "second_cosine cos(4 pi u/pitch) + second_sine sin(4 pi u/pitch)")
      .from("Heydemann, Applied Optics 20 (1981) 3382-3384 (errors of interpolation); counts: definition");
  d.remark(
      "divisions: 4 for quadrature (all edges of two square signals), thousands for interpolated sine and "
      "cosine signals, 0 for no quantization. If a block with memory follows, every count is an event of "
      "the simulation; a \"sample_hold\" after the encoder, as for one that is read at sampling instants, "
      "makes this much faster.");
  d.remark(
      "Offsets of the two signals cause the error with one period per pitch; unequal amplitudes and a "
      "phase other than 90 deg cause the error with two periods per pitch.");
  d.variation(error, d.type,
              {{"error_cosine", "0"}, {"error_sine", "0"}, {"second_cosine", "0"}, {"second_sine", "0"}});
  d.input(&Counting::In<double>::u, "u", unit, "the position");
  d.output(&Counting::Out<double>::y, "y", unit, "position reading of the encoder");
  d.param(&P::scale, scale, scale_unit, what).positive();
  d.param(&P::divisions, "divisions", "", "counts per line or pitch; 0 = no quantization").optional("4").not_negative();
  d.param(&P::cosine, "error_cosine", unit, "interpolation error, one period per pitch: cosine amplitude")
      .optional("0");
  d.param(&P::sine, "error_sine", unit, "interpolation error, one period per pitch: sine amplitude").optional("0");
  d.param(&P::second_cosine, "second_cosine", unit, "interpolation error, two periods per pitch: cosine amplitude")
      .optional("0");
  d.param(&P::second_sine, "second_sine", unit, "interpolation error, two periods per pitch: sine amplitude")
      .optional("0");
}

}  // namespace

void Encoder::describe(BlockSpec<Encoder>& spec) {
  spec.name("encoder", "rotary encoder: quantized angle with interpolation error");
  describe_counting(spec, "rad", "lines", "", "lines of the disc per revolution: the pitch is 360 deg/lines",
                    "interpolation_error");
}

void LinearEncoder::describe(BlockSpec<LinearEncoder>& spec) {
  spec.name("linear_encoder", "linear encoder: quantized position with interpolation error");
  describe_counting(spec, "m", "pitch", "m", "signal period of the scale, e.g. \"20 um\"", "periodic_error");
}

Kernel encoder_block() { return kernel<Encoder>(); }
Kernel linear_encoder_block() { return kernel<LinearEncoder>(); }

}  // namespace hysteron::blocks
