#include "draw/caption.h"

#include <fmt/format.h>

#include <algorithm>

namespace hysteron::draw {
namespace {

/// The value behind "$name": what the block that holds the diagram gives goes before the diagram's own.
const Value* look_up(const std::string& name, const Surroundings& around, const Surroundings*& found_in) {
  if (around.node != nullptr)
    if (const Value* given = around.node->parameters.find(name)) {
      found_in = around.outer;
      return given;
    }
  const DiagramParameter* parameter = around.diagram->parameters.find(name);
  found_in = &around;
  return parameter == nullptr ? nullptr : &parameter->value;
}

Value without_references(const Value& value, const Surroundings& around) {
  const Value* current = &value;
  const Surroundings* at = &around;
  for (int i = 0; i < 64; ++i) {
    const auto* reference = std::get_if<Reference>(&current->content);
    if (reference == nullptr || at == nullptr) break;
    const Value* next = look_up(reference->name, *at, at);
    if (next == nullptr) break;
    current = next;
  }
  return *current;
}

std::string number(double value) { return fmt::format("{:.6g}", value); }

/// The unit of a number: as written, else as declared where the declaration names one.
std::string unit_of(const Number& n, const ParameterDeclaration& declaration) {
  if (n.unit) return *n.unit;
  return declaration.unit.find('$') == std::string::npos ? declaration.unit : "";
}

std::string with_unit(const std::string& text, const std::string& unit) {
  return unit.empty() || unit == "1" ? text : text + " " + unit;
}

/// "[1, 2; 3, 4] V" row by row, or its size.
std::string matrix_text(const NumberMatrix& matrix, const ParameterDeclaration& declaration) {
  const std::size_t rows = matrix.rows.size(), columns = rows == 0 ? 0 : matrix.rows[0].size();
  if (rows * columns > 6) return fmt::format("{} x {} numbers", rows, columns);
  std::vector<std::string> lines;
  std::string unit;
  bool one_unit = true;
  for (const auto& row : matrix.rows) {
    std::vector<std::string> numbers;
    for (const auto& n : row) {
      numbers.push_back(number(n.value));
      const std::string of = unit_of(n, declaration);
      if (unit.empty()) unit = of;
      one_unit = one_unit && of == unit;
    }
    lines.push_back(fmt::format("{}", fmt::join(numbers, ", ")));
  }
  if (!one_unit) return fmt::format("{} x {} numbers", rows, columns);
  return with_unit(fmt::format("[{}]", fmt::join(lines, "; ")), unit);
}

std::string list_text(const NumberList& list, const ParameterDeclaration& declaration) {
  if (list.empty()) return "[]";
  if (list.size() == 1) return with_unit(number(list.front().value), unit_of(list.front(), declaration));
  const bool one_unit = std::all_of(list.begin(), list.end(), [&](const Number& n) {
    return unit_of(n, declaration) == unit_of(list.front(), declaration);
  });
  const auto element = [&](const Number& n) {
    return one_unit ? number(n.value) : with_unit(number(n.value), unit_of(n, declaration));
  };
  std::string text;
  const bool all = list.size() <= 4;
  for (std::size_t i = 0; i < (all ? list.size() : 2); ++i) text += (i > 0 ? ", " : "") + element(list[i]);
  if (!all) text += " … " + element(list.back());
  text = "[" + text + "]";
  if (one_unit) text = with_unit(text, unit_of(list.front(), declaration));
  return all ? text : fmt::format("{} ({})", text, list.size());
}

}  // namespace

const Value* Values::find(const std::string& name) const {
  for (const auto& [declaration, value] : list)
    if (declaration->name == name) return &value;
  return nullptr;
}

std::string Values::text(const std::string& name) const {
  for (const auto& [declaration, value] : list)
    if (declaration->name == name) return value_text(value, *declaration);
  return "";
}

std::vector<double> Values::numbers(const std::string& name) const {
  std::vector<double> result;
  const Value* value = find(name);
  if (value == nullptr) return result;
  if (const auto* one = std::get_if<Number>(&value->content)) result.push_back(one->value);
  if (const auto* many = std::get_if<NumberList>(&value->content))
    for (const auto& n : *many) result.push_back(n.value);
  return result;
}

Values values_of(const Node& node, const Declaration& declaration, const Surroundings& around) {
  Values values;
  for (const auto& parameter : declaration.parameters) {
    const Value* given = node.parameters.find(parameter.name);
    if (given == nullptr) given = node.parameters_from_file.find(parameter.name);
    if (given != nullptr) values.list.emplace_back(&parameter, without_references(*given, around));
  }
  return values;
}

std::string value_text(const Value& value, const ParameterDeclaration& declaration) {
  if (const auto* n = std::get_if<Number>(&value.content)) return with_unit(number(n->value), unit_of(*n, declaration));
  if (const auto* list = std::get_if<NumberList>(&value.content)) return list_text(*list, declaration);
  if (const auto* matrix = std::get_if<NumberMatrix>(&value.content)) return matrix_text(*matrix, declaration);
  if (const auto* text = std::get_if<std::string>(&value.content)) return *text;
  if (const auto* reference = std::get_if<Reference>(&value.content)) return "$" + reference->name;
  return "samples";
}

std::vector<std::string> caption_lines(const Values& values, const std::vector<std::string>& shown, std::size_t lines) {
  std::vector<std::string> result;
  for (const auto& [declaration, value] : values.list) {
    if (std::find(shown.begin(), shown.end(), declaration->name) != shown.end()) continue;
    if (std::holds_alternative<SeriesPointer>(value.content)) continue;
    result.push_back(declaration->name + " " + value_text(value, *declaration));
  }
  if (result.size() > lines) {
    result.resize(lines);
    result.back() = "…";
  }
  return result;
}

}  // namespace hysteron::draw
