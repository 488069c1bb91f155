#include "blocks/sources/constant.h"

namespace hysteron::blocks {

void Constant::describe(Declaration& d) {
  d.name("constant", "a value that never changes").in_group("sources").law("y = value").from("definition");
  d.remark("Write the value with its unit (\"20 degC\"): nothing else tells the unit of the signal.");
  d.output("y", "$a", "the value");
  d.parameter("value", "$a", "the value").offset();
}

Kernel constant_block() { return kernel<Constant>(); }

}  // namespace hysteron::blocks
