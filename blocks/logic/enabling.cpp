#include "blocks/logic/enabling.h"

namespace hysteron::blocks {

void EnablingLevel::describe(Declaration& d) {
  d.name("enabling", "whether a nested diagram runs").in_group("internal");
  d.law("y = 1 while the diagram runs, else 0").from("definition");
  d.inputs_any("in", "", "1 = true, 0 = false; above 1/2 counts as true");
  d.output("y", "", "1 while it runs");
  d.text("runs", {"enabled", "rising", "falling", "either"}, "while the signal is true, or at its edges");
}

Sizes EnablingLevel::sizes(const Shape&) {
  Sizes s;
  s.smoothness = Smoothness::jumps;
  s.feedthrough = false;  // its output tells of its mode
  return s;
}

Kernel enabling_block() { return kernel<EnablingLevel>(); }

}  // namespace hysteron::blocks
