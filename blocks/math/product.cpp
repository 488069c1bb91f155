#include "blocks/math/product.h"

namespace hysteron::blocks {

void Product::describe(BlockSpec<Product>& spec) {
  spec.name("product", "multiplies two signals").in_group("math").elementwise().law("y = a b").from("definition");
  spec.remark(
      "The unit of the output is the product of the units. For more factors connect several blocks in "
      "series.");
  spec.input(&In<double>::a, "a", "$a", "first factor");
  spec.input(&In<double>::b, "b", "$b", "second factor");
  spec.output(&Out<double>::y, "y", "$a*$b", "their product");
}

Kernel product_block() { return kernel<Product>(); }

}  // namespace hysteron::blocks
