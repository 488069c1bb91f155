#include "blocks/linear/biquads.h"

namespace hysteron::blocks {

void Biquads::describe(Declaration& d) {
  d.name("biquads", "second-order sections (biquads) in series").in_group("linear").elementwise().linear();
  d.law(
       "Y(s) = gain product_k (s^2/w_z^2 + 2 zero_dampings[k] s/w_z + 1)/(s^2/w_p^2 + 2 pole_dampings[k] s/w_p + 1) U(s), "
       "w_z = 2 pi zero_frequencies[k], w_p = 2 pi pole_frequencies[k]")
      .from("Franklin, Powell, Emami-Naeini, Feedback Control of Dynamic Systems, 8th ed. (2019), section 6.7");
  d.remark("Every section has static gain 1. With zeros at \"inf Hz\" a section has no zeros: it is a low-pass.");
  d.remark("A negative zero damping puts the zeros into the right half plane. For a single notch use \"notch\".");
  d.input("u", "$a", "the input");
  d.output("y", "$b", "the response");
  d.state("q", "$a", "per section: its input after the poles, and the rate of that over w_p");
  d.parameter("gain", "$b/$a", "static gain").optional("1").linear();
  d.list("zero_frequencies", "Hz", "natural frequency of the zeros of each section").positive();
  d.list("zero_dampings", "", "damping ratio of the zeros of each section").as_long_as("zero_frequencies");
  d.list("pole_frequencies", "Hz", "natural frequency of the poles of each section")
      .positive()
      .as_long_as("zero_frequencies");
  d.list("pole_dampings", "", "damping ratio of the poles of each section")
      .not_negative()
      .as_long_as("zero_frequencies");
}

Sizes Biquads::sizes(const Shape& shape) {
  Sizes s;
  const int n = shape.length("pole_frequencies");
  s.states = 2 * n;
  for (const char* list : {"zero_frequencies", "zero_dampings", "pole_dampings"})
    if (n < 1 || shape.length(list) != n)
      s.error =
          "\"zero_frequencies\", \"zero_dampings\", \"pole_frequencies\" and \"pole_dampings\" must be lists of one "
          "length; give one of each per section";
  return s;
}

void Biquads::rest(const View<double>& v) {
  for (int k = 0; k < v.n_x; ++k) v.out[k] = k % 2 == 0 ? v.u[0] : 0;  // every section has the static gain one
}

Kernel biquads_block() { return kernel<Biquads>(); }

}  // namespace hysteron::blocks
