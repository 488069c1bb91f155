#include "blocks/disturbances/mains.h"

namespace hysteron::blocks {

void MainsInterference::describe(Declaration& d) {
  d.name("mains_interference", "adds mains interference: a sine and its harmonics")
      .in_group("disturbances")
      .elementwise()
      .at("measured");
  d.law("y = u + sum_k cosine[k] cos(2 pi k frequency t) + sine[k] sin(2 pi k frequency t), k = 1, 2 ...")
      .from("Ott, Electromagnetic Compatibility Engineering (2009), chapter 3; a Fourier series");
  d.remark("The phase, and often the amplitude, differs between recordings: a fit estimates both per recording.");
  d.input("u", "$a", "the signal");
  d.output("y", "$a", "the signal with the interference");
  d.parameter("frequency", "Hz", "mains frequency, e.g. \"50 Hz\"").positive();
  d.list("cosine", "$a", "cosine amplitude of each harmonic; t = 0 at the start of the recording")
      .offset()
      .difference();
  d.list("sine", "$a", "sine amplitude of each harmonic").offset().difference().as_long_as("cosine");
}

Sizes MainsInterference::sizes(const Shape& shape) {
  Sizes s;
  if (shape.length("cosine") < 1 || shape.length("cosine") != shape.length("sine"))
    s.error = "\"cosine\" and \"sine\" must be lists of one length; give one of each per harmonic";
  return s;
}

Kernel mains_interference_block() { return kernel<MainsInterference>(); }

}  // namespace hysteron::blocks
