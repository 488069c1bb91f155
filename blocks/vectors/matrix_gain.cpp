#include "blocks/vectors/matrix_gain.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void MatrixGain::describe(Declaration& d) {
  d.name("matrix_gain", "multiplies a vector by a matrix").in_group("vectors").linear();
  d.law("y = matrix u").from("definition");
  d.remark("One row per output, one column per input: \"matrix\": [[\"1 um/V\", \"0.1 um/V\"], [0, \"2 um/V\"]].");
  d.remark(
      "Rows may have different output units, columns different input units; an element of 0 fits any unit, "
      "one without a unit keeps the unit of its column.");
  d.remark("An element of 0 is not a connection: a feedback path through it is not an algebraic loop.");
  d.input("u", "$a[i]", "the vector").vector();
  d.output("y", "$b[i]", "the matrix times the vector").vector();
  d.matrix("matrix", "$b[row]/$a[column]", "rows of the matrix; elements are output per input").linear();
}

Sizes MatrixGain::sizes(const Shape& shape) {
  Sizes s;
  s.outputs = shape.rows_of("matrix");
  s.output_lengths = {s.outputs};
  s.input_lengths = {shape.columns_of("matrix")};
  s.lengths_from = fmt::format("its matrix has {} row{} and {} column{}", s.outputs, s.outputs == 1 ? "" : "s",
                               s.input_lengths[0], s.input_lengths[0] == 1 ? "" : "s");
  return s;
}

Kernel matrix_gain_block() { return kernel<MatrixGain>(); }

}  // namespace hysteron::blocks
