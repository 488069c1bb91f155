#include "blocks/linear/transfer_function.h"

#include <fmt/format.h>

#include <algorithm>

namespace hysteron::blocks {

void TransferFunction::describe(Declaration& d) {
  d.name("transfer_function", "transfer function: ratio of two polynomials in s")
      .in_group("linear")
      .elementwise()
      .linear();
  d.law("Y(s) = gain num(s)/den(s) U(s)")
      .from("balanced companion form: Parlett, Reinsch, Numer. Math. 13 (1969) 293-304");
  d.remark(
      "Coefficients are plain numbers for s in 1/s, highest power first: \"den\": [1, 3, 2] is s^2 + 3 s + "
      "2. The unit of the block is that of its gain.");
  d.remark(
      "num must not be longer than den. With equal lengths there is direct feedthrough, so the block can "
      "be part of an algebraic loop.");
  d.remark("The states are scaled to the size of the input; they have no physical meaning.");
  d.input("u", "$a", "the input");
  d.output("y", "$b", "the response");
  d.state("x", "$a", "states of the chain, one per power of s");
  d.parameter("gain", "$b/$a", "factor on num/den; carries the unit").optional("1").linear();
  d.list("num", "", "numerator, highest power first");
  d.list("den", "", "denominator, highest power first");
}

Sizes TransferFunction::sizes(const Shape& shape) {
  Sizes s;
  const int n = shape.length("num");
  const int m = shape.length("den");
  if (n < 1 || m < 1)
    s.error = "\"num\" and \"den\" need at least one coefficient each; write e.g. \"num\": [1]";
  else if (n > m)
    s.error = fmt::format(
        "\"num\" has {} coefficients, \"den\" {}: this is not proper (it would differentiate); give num at "
        "most as many as den",
        n, m);
  s.states = std::max(m - 1, 0);
  s.constants = linear_system::chain_size(s.states);
  s.feedthrough = n == m;
  return s;
}

std::string TransferFunction::check(const View<double>& v) {
  if (v.list(den)[0] == 0) return "the first coefficient of \"den\" is zero; leave it out";
  return "";
}

void TransferFunction::prepare(const View<double>& v) {
  const auto order = static_cast<int>(v.list(den).size()) - 1;
  linear_system::realise(v.list(num), v.list(den), linear_system::chain_at(v.out, order));
}

Kernel transfer_function_block() { return kernel<TransferFunction>(); }

}  // namespace hysteron::blocks
