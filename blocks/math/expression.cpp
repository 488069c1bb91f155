#include "blocks/math/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "blocks/math/expression_units.h"
#include "engine/diagram/error.h"

namespace hysteron::blocks {
namespace {

using expression::Code;
using expression::Tree;
using expression::Wrong;

/// Which symbols are parameters of the block: those that its declaration names.
std::vector<bool> parameters_among(const Tree& tree, const Declaration& d) {
  std::vector<bool> is_parameter;
  for (const auto& symbol : tree.symbols)
    is_parameter.push_back(d.parameter_index(symbol) >= Expression::first_of_its_own);
  return is_parameter;
}

/// As many of the parameters as the value is affine in together, in the order of the text.
std::vector<bool> linear_among(const Tree& tree, const std::vector<bool>& is_parameter) {
  std::vector<bool> linear(is_parameter.size(), false);
  for (std::size_t i = 0; i < linear.size(); ++i) {
    linear[i] = is_parameter[i];
    if (linear[i] && expression::degree_in(tree, linear) > 1) linear[i] = false;
  }
  return linear;
}

/// The value jumps where these do, even if what they are multiplied with does not.
bool jumps(const Tree& tree) {
  return std::any_of(tree.parts.begin(), tree.parts.end(), [](const auto& part) {
    return part.is_logical() || part.is(expression::Op::sign) || part.is(expression::Op::mod) ||
           part.is(expression::Op::atan2) || (part.op >= expression::Op::floor && part.op <= expression::Op::round);
  });
}

void refuse_unused(const Tree& tree, const Declaration& type, const Node& block) {
  Problems problems;
  for (const auto& [name, value] : block.parameters)
    if (type.parameter_index(name) < 0 &&
        std::find(tree.symbols.begin(), tree.symbols.end(), name) == tree.symbols.end())
      problems.add("unknown_parameter", "/" + name, fmt::format("the expression has no \"{}\"", name),
                   tree.symbols.empty() ? "take it out" : did_you_mean(name, tree.symbols));
  problems.throw_if_any();
}

}  // namespace

void Expression::describe(Declaration& d) {
  d.name("expression", "formula written in the diagram: \"a*sin(b*u) + max(u, 0)\"").in_group("math").elementwise();
  d.law("y = value of the expression").from("definition; grammar: models/math/expression_tree.h");
  d.named_by("y");
  d.remark(
      "Every name in the expression is a parameter if the block has a value for it (\"a\": \"2 um\"), else "
      "an input, in order of first appearance: \"in\": {\"u\": \"drive\"}, or \"in\": \"drive\" if there "
      "is only one.");
  d.remark(
      "Operators + - * / ^ < <= > >= == != and or not; functions abs sign min max floor ceil round mod sqrt cbrt exp "
      "log log10 sin cos tan asin acos atan atan2 sinh cosh tanh hypot pow if(condition, then, else); the number pi. "
      "True is 1, false 0; what is above 0.5 counts as true.");
  d.remark(
      "Units are checked: terms that are added or compared must have the same unit, sin(x) takes an angle "
      "or a plain number, sqrt takes the root of the unit, and an exponent must be a number if the base "
      "has a unit. Numbers in the expression have no unit; 0 fits any unit.");
  d.remark(
      "Parameters can be fitted, set and varied like those of any block; those in which the value is "
      "affine are found by linear least squares. Kinks and jumps (abs, min, max, sign, if, comparisons, "
      "floor) are located.");
  d.inputs_any("in", "$in", "the names in the expression that are not parameters, in order of appearance");
  d.output("y", "$result", "value of the expression");
  d.text("y", {}, "the expression");
  d.text("unit", {}, "unit of the value; needed where wires and parameters do not determine it").optional("");
}

Declaration Expression::instance(const Declaration& type, const Node& block) {
  const auto text_at = [&](const std::string& name) {
    const Value* given = block.parameters.find(name);
    if (given == nullptr) given = block.parameters_from_file.find(name);
    const auto text = given == nullptr ? std::optional<std::string>("") : written_text(*given);
    if (!text)
      fail("wrong_type", "/" + name, fmt::format("\"{}\" of expression is a text", name), "write it in quotes");
    return *text;
  };
  Tree tree;
  try {
    tree = expression::parse(text_at("y"));
    refuse_unused(tree, type, block);
    std::vector<bool> is_parameter;
    for (const auto& symbol : tree.symbols)
      is_parameter.push_back(type.parameter_index(symbol) < 0 && (block.parameters.find(symbol) != nullptr ||
                                                                  block.parameters_from_file.find(symbol) != nullptr));
    expression::compile(tree, is_parameter);
    if (const std::string unit = text_at("unit"); !unit.empty()) parse_unit(unit, "/unit");
    Declaration d = type;
    d.equation = "y = " + text_at("y");
    d.inputs.clear();
    d.outputs.front().unit = "$.y";  // no name in the text is like it
    std::vector<bool> inputs = is_parameter;
    inputs.flip();
    d.is_linear = expression::degree_in(tree, inputs) <= 1;
    const auto linear = linear_among(tree, is_parameter);
    for (std::size_t i = 0; i < tree.symbols.size(); ++i) {
      const std::string& name = tree.symbols[i];
      const std::string where = fmt::format("\"{}\" of the expression, at its character {}", name, tree.symbol_at[i]);
      if (!is_parameter[i])
        d.input(name, "$" + name, where + "; or a parameter: give the block a value for it");
      else
        d.parameter(name, "$" + name, where).is_linear = linear[i];
    }
    return d;
  } catch (const Wrong& wrong) {
    fail("bad_value", "/y", fmt::format("\"y\": {}", wrong.what()), wrong.cure);
  }
}

Sizes Expression::sizes(const Shape& shape) {
  Sizes s;
  try {
    const Tree tree = expression::parse(shape.free_text("y"));
    s.code = expression::compile(tree, parameters_among(tree, *shape.declaration)).code;
    s.constants = static_cast<int>(s.code.size());
    s.kinks = Code::count(s.code.data(), Code::kinks);
    if (jumps(tree)) s.smoothness = Smoothness::jumps;
    if (const int n = Code::count(s.code.data(), Code::inputs); n != shape.inputs)
      s.error = fmt::format("{} wires for {} inputs of the expression", shape.inputs, n);
  } catch (const Wrong& wrong) {
    s.error = wrong.what();
  }
  return s;
}

void Expression::units(const Shape& shape, InstanceUnits& units) {
  const Declaration& d = *shape.declaration;
  units.parameter = "y";
  try {
    const Tree tree = expression::parse(shape.free_text("y"));
    expression::UnitsOfTree of{std::vector<InstanceUnits::Known>(tree.symbols.size()), units.outputs.front()};
    std::vector<InstanceUnits::Known*> known;
    std::size_t input = 0;
    for (const auto& symbol : tree.symbols) {
      const int own = d.parameter_index(symbol);
      known.push_back(own >= first_of_its_own ? &units.parameters[static_cast<std::size_t>(own)]
                                              : &units.inputs[input++]);
    }
    for (std::size_t i = 0; i < known.size(); ++i) of.symbols[i] = *known[i];
    if (const std::string stated = shape.free_text("unit"); !stated.empty() && !of.whole)
      of.whole = parse_unit(stated).dimension;
    expression::infer_units(tree, of, units.name);
    for (std::size_t i = 0; i < known.size(); ++i) *known[i] = of.symbols[i];
    units.outputs.front() = of.whole;
  } catch (const Wrong& wrong) {
    units.error = wrong.what();
    units.cure = wrong.cure;
  }
}

/// A chunk of numbers at a time, one operation after the other: the text costs nothing per number.
void Expression::rows(const RowsView& r) {
  constexpr int chunk = 64;  // numbers of all lanes; what a chunk needs stays in the nearest cache
  const double* code = r.views[0].c;
  const int inputs = Code::count(code, Code::inputs), parameters = Code::count(code, Code::parameters),
            numbers = Code::count(code, Code::numbers);
  std::array<double, static_cast<std::size_t>(Code::most_slots * chunk)> work;
  std::array<const double*, static_cast<std::size_t>(Code::most_slots)> at;
  const auto slot = [&](int i) { return work.data() + static_cast<std::ptrdiff_t>(i) * chunk; };
  for (int i = 0; i < parameters + numbers; ++i) at[static_cast<std::size_t>(inputs + i)] = slot(i);
  for (int i = 0; i < numbers; ++i) std::fill_n(slot(parameters + i), chunk, code[Code::head_size + i]);
  const auto fill_parameters = [&](std::ptrdiff_t begin) {
    for (int i = 0; i < parameters; ++i)
      for (int k = 0; k < chunk; ++k) slot(i)[k] = r.views[(begin + k) % r.lanes].parameter(first_of_its_own + i);
  };
  const bool same_lanes_in_every_chunk = chunk % r.lanes == 0;
  const std::ptrdiff_t all = static_cast<std::ptrdiff_t>(r.count) * r.lanes;
  for (std::ptrdiff_t begin = 0; begin < all; begin += chunk) {
    if (begin == 0 || !same_lanes_in_every_chunk) fill_parameters(begin);
    for (int i = 0; i < inputs; ++i) at[static_cast<std::size_t>(i)] = r.u[i] + begin;
    const int n = static_cast<int>(std::min<std::ptrdiff_t>(chunk, all - begin));
    std::copy_n(expression::evaluate_rows<chunk>(code, at.data(), slot(parameters + numbers), n), n, r.y[0] + begin);
  }
}

Kernel expression_block() {
  Kernel k = kernel<Expression>();
  k.instance = &Expression::instance;
  k.units = &Expression::units;
  return k;
}

}  // namespace hysteron::blocks
