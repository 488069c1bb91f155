#include "blocks/math/trigonometry.h"

#include <fmt/format.h>

#include "blocks/math/expression_units.h"

namespace hysteron::blocks {

void Trigonometry::describe(Declaration& d) {
  d.name("trigonometry", "trigonometric and hyperbolic functions").in_group("math").elementwise();
  d.law("y = sin u, ..., atan2(u_1, u_2)").from("definition");
  d.remark(
      "sin, cos and tan take an angle, or a plain number, which is read as rad; asin, acos, atan and atan2 "
      "return an angle.");
  d.remark("atan2 takes two wires, y and x, in the same unit; its jump from pi to -pi is located.");
  d.inputs_any("in", "$in", "argument of the function; for atan2 two: y and x");
  d.output("y", "$y", "the value");
  d.text("function", {"sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh"}, "the function");
}

Sizes Trigonometry::sizes(const Shape& shape) {
  Sizes s;
  const bool two = shape.text("function") == "atan2";
  if (shape.inputs != (two ? 2 : 1))
    s.error = fmt::format("{} takes {}, found {}", shape.text("function"), two ? "two inputs, y and x" : "one input",
                          shape.inputs);
  s.kinks = two ? 1 : 0;
  if (two) s.smoothness = Smoothness::jumps;
  s.input_units = {"$a", "$b"};
  return s;
}

void Trigonometry::units(const Shape& shape, InstanceUnits& units) {
  const auto& name = shape.text("function");
  units.parameter = "function";
  try {
    const auto tree = expression::parse(name + (units.inputs.size() > 1 ? "(a, b)" : "(a)"));
    expression::UnitsOfTree of{units.inputs, units.outputs.front()};
    expression::infer_units(tree, of, units.name);
    units.inputs = of.symbols;
    units.outputs.front() = of.whole;
  } catch (const expression::Wrong& wrong) {
    units.error = wrong.what();
    units.cure = wrong.cure;
  }
}

void Trigonometry::kinks(const View<double>& v) {
  if (v.n_u > 1) v.out[0] = expression::kink(expression::Op::atan2, v.u[0], v.u[1]);
}

Kernel trigonometry_block() {
  Kernel k = kernel<Trigonometry>();
  k.units = &Trigonometry::units;
  return k;
}

}  // namespace hysteron::blocks
