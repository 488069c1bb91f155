#include "blocks/linear/zero_pole_gain.h"

#include <fmt/format.h>

#include "models/linear/second_order.h"

namespace hysteron::blocks {

void ZeroPoleGain::describe(Declaration& d) {
  d.name("zero_pole_gain", "transfer function by zeros, poles and gain").in_group("linear").elementwise().linear();
  d.law("Y(s) = gain product (s - zero)/product (s - pole) U(s), a pair [a, b] being the factor (s - a)^2 + b^2")
      .from("balanced companion form: Parlett, Reinsch, Numer. Math. 13 (1969) 293-304");
  d.remark(
      "Zeros and poles are plain numbers in 1/s. The gain carries the unit; it is the ratio of the leading "
      "coefficients, not the static gain. Real zeros and poles are given in \"zeros\" and \"poles\": "
      "\"poles\": [-5, -40].");
  d.remark(
      "Complex ones come in pairs, [real part, imaginary part]: \"pole_pairs\": [[-3, 40]] is -3 + 40i and -3 - 40i.");
  d.remark("For sections by frequency and damping use \"biquads\", for coefficients \"transfer_function\".");
  d.input("u", "$a", "the input");
  d.output("y", "$b", "the response");
  d.state("x", "$a", "states of the chain, one per pole");
  d.parameter("gain", "$b/$a", "ratio of the leading coefficients; carries the unit").optional("1").linear();
  d.list("zeros", "", "real zeros [1/s]").optional("");
  d.matrix("zero_pairs", "", "complex zeros [1/s], one row [real, imaginary] per pair").optional("");
  d.list("poles", "", "real poles [1/s]").optional("");
  d.matrix("pole_pairs", "", "complex poles [1/s], one row [real, imaginary] per pair").optional("");
}

Sizes ZeroPoleGain::sizes(const Shape& shape) {
  Sizes s;
  const int n = shape.length("zeros") + 2 * shape.rows_of("zero_pairs");
  s.states = shape.length("poles") + 2 * shape.rows_of("pole_pairs");
  s.constants = linear_system::chain_size(s.states);
  s.feedthrough = n == s.states;
  for (const char* pairs : {"zero_pairs", "pole_pairs"})
    if (shape.rows_of(pairs) > 0 && shape.columns_of(pairs) != 2)
      s.error = fmt::format("\"{}\" has {} columns; write one row [real part, imaginary part] per pair", pairs,
                            shape.columns_of(pairs));
  if (s.error.empty() && n > s.states)
    s.error = fmt::format(
        "{} zeros and {} poles: this is not proper (it would differentiate); give at most as many zeros as "
        "poles",
        n, s.states);
  return s;
}

void ZeroPoleGain::prepare(const View<double>& v) {
  const auto num = second_order::polynomial(v.list(zeros), v.list(zero_pairs));
  const auto den = second_order::polynomial(v.list(poles), v.list(pole_pairs));
  linear_system::realise(num, den, linear_system::chain_at(v.out, static_cast<int>(den.size()) - 1));
}

Kernel zero_pole_gain_block() { return kernel<ZeroPoleGain>(); }

}  // namespace hysteron::blocks
