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
      "divisions: 4 for the edges of two square signals, thousands where sine and cosine are interpolated, 0 where nothing is "
      "counted. Every count is an event of a simulation where something that remembers follows; a \"sample_hold\" behind it "
      "makes an encoder that is read at instants, and cheap.");
  d.remark(
      "Offsets of the two signals make the errors of once a pitch, unequal amplitudes and a phase other than 90 deg those of "
      "twice a pitch.");
  d.variation(error, d.type,
              {{"error_cosine", "0"}, {"error_sine", "0"}, {"second_cosine", "0"}, {"second_sine", "0"}});
  d.input(&Counting::In<double>::u, "u", unit, "the position");
  d.output(&Counting::Out<double>::y, "y", unit, "what the encoder tells");
  d.param(&P::scale, scale, scale_unit, what).positive();
  d.param(&P::divisions, "divisions", "", "counts per line or pitch; 0 = the position itself")
      .optional("4")
      .not_negative();
  d.param(&P::cosine, "error_cosine", unit, "error of the interpolation once a pitch: cosine").optional("0");
  d.param(&P::sine, "error_sine", unit, "the same: sine").optional("0");
  d.param(&P::second_cosine, "second_cosine", unit, "error of the interpolation twice a pitch: cosine").optional("0");
  d.param(&P::second_sine, "second_sine", unit, "the same: sine").optional("0");
}

}  // namespace

void Encoder::describe(BlockSpec<Encoder>& spec) {
  spec.name("encoder", "counts of an angle, with the error of their interpolation");
  describe_counting(spec, "rad", "lines", "", "of the disc, per turn: the pitch is 360 deg/lines",
                    "interpolation_error");
}

void LinearEncoder::describe(BlockSpec<LinearEncoder>& spec) {
  spec.name("linear_encoder", "counts along a scale, with the error of their interpolation");
  describe_counting(spec, "m", "pitch", "m", "period of the signals along the scale, e.g. \"20 um\"", "periodic_error");
}

Kernel encoder_block() { return kernel<Encoder>(); }
Kernel linear_encoder_block() { return kernel<LinearEncoder>(); }

}  // namespace hysteron::blocks
