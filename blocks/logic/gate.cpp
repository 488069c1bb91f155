#include "blocks/logic/gate.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void LogicGate::describe(Declaration& d) {
  d.name("logic", "and, or, not, exclusive or: 1 or 0").in_group("logic").elementwise();
  d.law("y = 1 if the inputs are true as \"is\" asks, else 0; true is what lies above 1/2").from("definition");
  d.remark("Longer conditions are shorter as an \"expression\": \"a and not (b or c > 2)\".");
  d.inputs_any("in", "", "signals that are 1 (true) or 0 (false)");
  d.output("y", "", "1 = true, 0 = false");
  d.text("is", {"and", "or", "nand", "nor", "xor", "not"}, "xor: an odd number of them is true; not: of one input");
}

Sizes LogicGate::sizes(const Shape& shape) {
  Sizes s;
  s.smoothness = Smoothness::jumps;
  s.kinks = shape.inputs;
  if (shape.text("is") == "not" && shape.inputs != 1)
    s.error = fmt::format("\"not\" takes one input, found {}; nor is true where none of several is", shape.inputs);
  return s;
}

void LogicGate::kinks(const View<double>& v) {
  for (int i = 0; i < v.n_u; ++i) v.out[i] = v.u[i] - logic::level;
}

Kernel logic_block() { return kernel<LogicGate>(); }

}  // namespace hysteron::blocks
