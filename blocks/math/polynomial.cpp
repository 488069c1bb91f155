#include "blocks/math/polynomial.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void Polynomial::describe(Declaration& d) {
  d.name("polynomial", "static curve: polynomial, extended by its tangents outside limits")
      .in_group("math")
      .elementwise()
      .at("core");
  d.law(
       "y = sum coefficients[k] x^k, x = (u - about)/reference, for lower <= u <= upper; beyond, the tangent at the "
       "limit")
      .from("definition; Horner's rule");
  d.remark(
      "The reference scales the input: with \"reference\": \"1 V\", coefficients given in um are um, um/V, "
      "um/V^2 ...");
  d.remark(
      "If the range of the input is far from zero, set the expansion point: temperatures count from "
      "absolute zero, so a curve around 20 degC has \"about\": \"20 degC\".");
  d.remark(
      "Outside its data a polynomial diverges quickly: set the limits to the range of the data, or to "
      "\"-inf V\" and \"inf V\" for none.");
  d.input("u", "$a", "the input");
  d.output("y", "$b", "value of the curve");
  d.list("coefficients", "$b", "coefficients: constant, linear, quadratic ...").linear().difference();
  d.parameter("reference", "$a", "input change over which x increases by 1").positive().difference();
  d.parameter("lower", "$a", "lower limit: below it the curve continues as its tangent");
  d.parameter("upper", "$a", "upper limit: above it the curve continues as its tangent");
  d.parameter("about", "$a", "expansion point: input at which x is 0").optional("0");
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
