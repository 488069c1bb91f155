#include "blocks/disturbances/mains.h"

namespace hysteron::blocks {

void MainsInterference::describe(Declaration& d) {
  d.name("mains_interference", "a line of the mains and its harmonics on top of the signal")
      .in_group("disturbances")
      .elementwise()
      .at("measured");
  d.law("y = u + sum_k cosine[k] cos(2 pi k frequency t) + sine[k] sin(2 pi k frequency t), k = 1, 2 ...")
      .from("Ott, Electromagnetic Compatibility Engineering (2009), chapter 3; a Fourier series");
  d.remark("Its phase is another one in every recording, and often its size: a fit finds both per recording.");
  d.input("u", "$a", "the signal");
  d.output("y", "$a", "the signal with the line");
  d.parameter("frequency", "Hz", "of the mains").positive();
  d.list("cosine", "$a", "amplitude of the cosine at t = 0 of the recording, per harmonic").offset().difference();
  d.list("sine", "$a", "amplitude of the sine, per harmonic").offset().difference().as_long_as("cosine");
}

Sizes MainsInterference::sizes(const Shape& shape) {
  Sizes s;
  if (shape.length("cosine") < 1 || shape.length("cosine") != shape.length("sine"))
    s.error = "\"cosine\" and \"sine\" must be lists of one length; give one of each per harmonic";
  return s;
}

Kernel mains_interference_block() { return kernel<MainsInterference>(); }

}  // namespace hysteron::blocks
