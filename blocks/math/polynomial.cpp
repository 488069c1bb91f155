#include "blocks/math/polynomial.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void Polynomial::describe(Declaration& d) {
  d.name("polynomial", "static curve: a polynomial, straight on beyond two limits")
      .in_group("math")
      .elementwise()
      .at("core");
  d.law(
       "y = sum coefficients[k] x^k, x = (u - about)/reference, for lower <= u <= upper; beyond, the tangent at the "
       "limit")
      .from("definition; Horner's rule");
  d.remark(
      "The reference is the input for which the coefficients are given: with 1 V, coefficients in um are um, um/V, "
      "um/V^2 ...");
  d.remark(
      "Where zero is far from what the input does, say what the powers are about: a temperature is counted from "
      "absolute zero, and a curve about 20 degC has \"about\": \"20 degC\".");
  d.remark("A polynomial leaves its data quickly: set the limits to the range that it was found on, or to \"-inf V\".");
  d.input("u", "$a", "the input");
  d.output("y", "$b", "the curve at the input");
  d.list("coefficients", "$b", "constant, linear, quadratic ... coefficient").linear().difference();
  d.parameter("reference", "$a", "input at which x is 1").positive().difference();
  d.parameter("lower", "$a", "below this input the curve is straight");
  d.parameter("upper", "$a", "above this input the curve is straight");
  d.parameter("about", "$a", "input at which x is 0").optional("0");
}

Sizes Polynomial::sizes(const Shape& shape) {
  Sizes s;
  if (shape.length("coefficients") < 1) s.error = "\"coefficients\" is empty; give one, the constant, at least";
  return s;
}

std::string Polynomial::check(const View<double>& v) {
  if (!(v.parameter(lower) < v.parameter(upper))) return "lower, {lower}, is not below upper, {upper}; exchange them";
  return "";
}

Kernel polynomial_block() { return kernel<Polynomial>(); }

}  // namespace hysteron::blocks
