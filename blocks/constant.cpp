#include "blocks/constant.h"

namespace hysteron::blocks {

void Constant::describe(BlockSpec<Constant>& spec) {
  spec.name("constant", "a value that never changes").in_group("sources").law("y = value").from("definition");
  spec.remark("Write the value with its unit (\"20 degC\"): nothing else tells the unit of the signal.");
  spec.output(&Out<double>::y, "y", "$a", "the value");
  spec.param(&Params<double>::value, "value", "$a", "the value").offset();
}

Kernel constant_block() { return kernel<Constant>(); }

}  // namespace hysteron::blocks
