#include "blocks/sampled/discrete_transfer_function.h"

namespace hysteron::blocks {

void DiscreteTransferFunction::describe(Declaration& d) {
  d.name("discrete_transfer_function", "discrete transfer function: ratio of two polynomials in z^-1")
      .in_group("sampled")
      .elementwise()
      .linear();
  d.law("Y/U = gain (num[1] + num[2] z^-1 + ...)/(den[1] + den[2] z^-1 + ...); direct \"no\": num[1] belongs to z^-1")
      .from(
          "Oppenheim, Schafer, Discrete-Time Signal Processing, 3rd ed. (2010), chapter 6 (direct form II transposed)");
  d.remark(
      "Coefficients are plain numbers, that of the present sample (z^0) first. The unit of the block is "
      "that of its gain.");
  d.remark(
      "With \"direct\": \"no\" there is no direct feedthrough, so a loop of sampled blocks can be closed "
      "around it.");
  d.remark("The output is held between the sampling instants.");
  d.input("u", "$a", "the input");
  d.output("y", "$b", "the response");
  d.state("w", "$a", "states of the direct form");
  d.parameter("gain", "$b/$a", "factor on num/den; carries the unit").optional("1").linear();
  d.list("num", "", "numerator, present sample first");
  d.list("den", "", "denominator, present sample first");
  d.text("direct", {"yes", "no"}, "direct feedthrough: whether the output depends on the input of the same instant");
  d.parameter("before", "$a", "constant input before the first instant, for the initial states").optional("0");
  d.sampled();
}

Sizes DiscreteTransferFunction::sizes(const Shape& shape) {
  Sizes s;
  const int n = shape.length("num"), m = shape.length("den");
  const bool at_once = shape.text("direct") == "yes";
  if (n < 1 || m < 1) {
    s.error = "\"num\" and \"den\" need at least one coefficient each; write e.g. \"num\": [1]";
    return s;
  }
  s.sampled_states = static_cast<int>(
      discrete_filter::states(static_cast<std::size_t>(at_once ? n : n + 1), static_cast<std::size_t>(m)));
  s.feedthrough = at_once;
  return s;
}

std::string DiscreteTransferFunction::check(const View<double>& v) {
  if (v.list(den)[0] == 0) return "the first coefficient of \"den\" is zero; leave it out, and shorten \"num\" as well";
  return "";
}

void DiscreteTransferFunction::initial_states(const View<double>& v) {
  discrete_filter::rest(coefficients(v), v.parameter(before), {v.out, static_cast<std::size_t>(v.n_x)});
}

Kernel discrete_transfer_function_block() { return kernel<DiscreteTransferFunction>(); }

}  // namespace hysteron::blocks
