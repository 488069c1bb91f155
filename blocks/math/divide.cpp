#include "blocks/math/divide.h"

namespace hysteron::blocks {

void Divide::describe(BlockSpec<Divide>& spec) {
  spec.name("divide", "divides one signal by another").in_group("math").elementwise().law("y = a/b").from("definition");
  spec.remark("If b passes through zero, the run ends with an error.");
  spec.input(&In<double>::a, "a", "$a", "the numerator");
  spec.input(&In<double>::b, "b", "$b", "the denominator");
  spec.output(&Out<double>::y, "y", "$a/$b", "the quotient");
}

Kernel divide_block() { return kernel<Divide>(); }

}  // namespace hysteron::blocks
