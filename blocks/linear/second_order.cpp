#include "blocks/linear/second_order.h"

namespace hysteron::blocks {

void SecondOrder::describe(Declaration& d) {
  d.name("second_order", "second-order low-pass, band-pass or high-pass").in_group("linear").elementwise().linear();
  d.law(
       "Y(s) = gain N(s)/(s^2 + 2 damping w s + w^2) U(s), w = 2 pi frequency; N = w^2 (low), 2 damping w s (band), s^2 (high)")
      .from("second-order sections, definition");
  d.remark(
      "Frequencies may also be given in rad/s: \"50 rad/s\". damping 0.7071 is a Butterworth filter, 1 is "
      "critically damped.");
  d.remark("With gain 1 and \"pass\": \"low\" the block equals \"resonance\".");
  d.input("u", "$a", "the input");
  d.output("y", "$b", "the response");
  d.state("q", "$a", "the input after the low-pass, then its rate over w");
  d.parameter("gain", "$b/$a", "gain in the pass band (band-pass: at the centre)").optional("1").linear();
  d.parameter("frequency", "Hz", "undamped natural frequency").positive();
  d.parameter("damping", "", "damping ratio").not_negative();
  d.text("pass", {"low", "band", "high"}, "type: low-pass, band-pass or high-pass");
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
