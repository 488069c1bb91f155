#include "blocks/logic/gate.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void LogicGate::describe(Declaration& d) {
  d.name("logic", "logic gate: and, or, nand, nor, xor, not").in_group("logic").elementwise();
  d.law("y = 1 if the operation \"is\" of the inputs is true, else 0; above 1/2 counts as true").from("definition");
  d.remark("Longer conditions are easier to write as an \"expression\": \"a and not (b or c > 2)\".");
  d.inputs_any("in", "", "1 = true, 0 = false; above 1/2 counts as true");
  d.output("y", "", "1 = true, 0 = false");
  d.text("is", {"and", "or", "nand", "nor", "xor", "not"},
         "logic operation; xor: an odd number of inputs is true; not: one input");
}

Sizes LogicGate::sizes(const Shape& shape) {
  Sizes s;
  s.smoothness = Smoothness::jumps;
  s.kinks = shape.inputs;
  if (shape.text("is") == "not" && shape.inputs != 1)
    s.error = fmt::format("\"not\" takes one input, found {}; for several inputs use \"nor\"", shape.inputs);
  return s;
}

void LogicGate::kinks(const View<double>& v) {
  for (int i = 0; i < v.n_u; ++i) v.out[i] = v.u[i] - logic::level;
}

Kernel logic_block() { return kernel<LogicGate>(); }

}  // namespace hysteron::blocks
