#include "blocks/linear/second_order.h"

namespace hysteron::blocks {

void SecondOrder::describe(Declaration& d) {
  d.name("second_order", "low-pass, band-pass or high-pass of second order by frequency and damping")
      .in_group("linear")
      .elementwise()
      .linear();
  d.law(
       "Y(s) = gain N(s)/(s^2 + 2 damping w s + w^2) U(s), w = 2 pi frequency; N = w^2 (low), 2 damping w s (band), s^2 (high)")
      .from("second-order sections, definition");
  d.remark("A frequency may be written in rad/s, too: \"50 rad/s\". damping 0.7071 is Butterworth's, 1 does not ring.");
  d.remark("With gain one and \"pass\": \"low\" it is \"resonance\", which stages are described by.");
  d.input("u", "$a", "the input");
  d.output("y", "$b", "the response");
  d.state("q", "$a", "the input behind the low-pass, then its rate over w");
  d.parameter("gain", "$b/$a", "gain in the passed band").optional("1").linear();
  d.parameter("frequency", "Hz", "undamped natural frequency").positive();
  d.parameter("damping", "", "damping ratio").not_negative();
  d.text("pass", {"low", "band", "high"}, "which frequencies pass");
}

Sizes SecondOrder::sizes(const Shape& shape) {
  Sizes s;
  s.states = 2;
  s.feedthrough = shape.text("pass") == "high";
  return s;
}

void SecondOrder::rest(const View<double>& v) {
  v.out[0] = v.u[0];
  v.out[1] = 0;
}

Kernel second_order_block() { return kernel<SecondOrder>(); }

}  // namespace hysteron::blocks
