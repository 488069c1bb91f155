#include "blocks/math/sum.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void Sum::describe(Declaration& d) {
  d.name("sum", "adds and subtracts signals").in_group("math").elementwise().linear();
  d.law("y = +- u_1 +- u_2 ...").from("definition");
  d.remark("All signals must have one unit. \"signs\": \"+-\" subtracts the second wire; without it all are added.");
  d.inputs_any("in", "$a", "the signals, in the order of the signs");
  d.output("y", "$a", "their sum");
  d.text("signs", {}, "one sign, + or -, per wire; all + if left out").optional("");
}

Sizes Sum::sizes(const Shape& shape) {
  Sizes s;
  const int n = shape.length("signs");
  if (n != 0 && n != shape.inputs)
    s.error = fmt::format("{} signs for {} wires; write one + or - per wire", n, shape.inputs);
  return s;
}

std::string Sum::check(const View<double>& v) {
  for (const double code : v.list(signs))
    if (code != '+' && code != '-')
      return fmt::format("\"signs\" holds the character '{}'; write only + and -", static_cast<char>(code));
  return "";
}

Kernel sum_block() { return kernel<Sum>(); }

}  // namespace hysteron::blocks
