#include "blocks/sources/constant.h"

namespace hysteron::blocks {

void Constant::describe(Declaration& d) {
  d.name("constant", "constant value").in_group("sources").law("y = value").from("definition");
  d.remark("Write the value with its unit (\"20 degC\"): it sets the unit of the signal.");
  d.output("y", "$a", "the constant value");
  d.parameter("value", "$a", "the constant value").offset();
}

Kernel constant_block() { return kernel<Constant>(); }

}  // namespace hysteron::blocks
