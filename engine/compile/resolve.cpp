// Decides which number each parameter of a block gets: default < parameter set < block < diagram parameter by "$name".
// Does not check physics: that is the block's own check() once all numbers are known.
#include "engine/compile/resolve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/block/instance.h"
#include "engine/diagram/value_text.h"
#include "engine/program/parameter_values.h"

namespace hysteron {
namespace {

/// Reads the numbers of one parameter and reports what is wrong with them.
class Resolver {
 public:
  Resolver(const Scope& scope, const Node& node, const Declaration& declaration, std::string origin,
           Ordered<GraphParameter>& parameters, Problems& problems)
      : scope_(scope),
        node_(node),
        declaration_(declaration),
        origin_(std::move(origin)),
        parameters_(parameters),
        problems_(problems) {}

  std::vector<ResolvedParameter> all() {
    check_names();
    std::vector<ResolvedParameter> list;
    for (const auto& p : declaration_.parameters) list.push_back(one(p));
    check_lengths(list);
    return list;
  }

 private:
  void check_names() {
    const auto known = declaration_.parameter_names();
    const auto check = [&](const Ordered<Value>& values) {
      for (const auto& [name, value] : values) {
        if (declaration_.parameter_index(name) >= 0) continue;
        if (declaration_.is_series && (name == "samples" || name == "file" || name == "column" || name == "unit"))
          continue;
        problems_.add("unknown_parameter", place(name),
                      fmt::format("{} has no parameter \"{}\"", declaration_.type, name), did_you_mean(name, known));
      }
    };
    check(node_.parameters);
    check(node_.parameters_from_file);
  }

  /// Where a value of that name was written, or would be.
  std::string place(const std::string& name) const {
    const Value* given = node_.parameters.find(name);
    return given != nullptr && was_set(given->origin) ? given->origin : origin_ + "/" + name;
  }

  ResolvedParameter one(const ParameterDeclaration& p) {
    const Value* given = node_.parameters.find(p.name);
    if (given == nullptr) given = node_.parameters_from_file.find(p.name);
    if (given != nullptr) return from_value(p, *given, "", 0);
    ResolvedParameter result;
    result.list = p.kind == ParameterKind::list || p.kind == ParameterKind::matrix;
    if (p.kind == ParameterKind::text && p.choices.empty()) return result;  // free text: empty by default
    if (p.kind == ParameterKind::list || p.kind == ParameterKind::matrix)
      if (p.default_text && p.default_text->empty()) return result;  // none by default
    if (!p.default_text) {
      problems_.add("missing_parameter", place(p.name),
                    fmt::format("{} needs a parameter \"{}\": {}", declaration_.type, p.name, p.meaning),
                    p.unit.empty() || p.unit.find('$') != std::string::npos
                        ? fmt::format("add \"{}\"", p.name)
                        : fmt::format("add \"{}\" in {}", p.name, p.unit));
      result.numbers.push_back({});
      return result;
    }
    return from_value(p, Value(*p.default_text), "", 0);
  }

  ResolvedParameter from_value(const ParameterDeclaration& p, const Value& value, const std::string& name, int depth) {
    ResolvedParameter result;
    result.list = p.kind == ParameterKind::list;
    if (const auto* reference = std::get_if<Reference>(&value.content)) return from_reference(p, *reference, depth);
    if (p.kind == ParameterKind::text) return from_text(p, value);
    if (p.kind == ParameterKind::matrix || (p.may_be_matrix && std::holds_alternative<NumberMatrix>(value.content)))
      return from_matrix(p, value, name);
    if (const auto* number = std::get_if<Number>(&value.content)) {
      if (p.kind == ParameterKind::list) result.list = true;
      result.numbers.push_back(resolve(p, *number, name, value));
      return result;
    }
    if (const auto* list = std::get_if<NumberList>(&value.content); list != nullptr && p.kind == ParameterKind::list) {
      for (const auto& number : *list) result.numbers.push_back(resolve(p, number, name, value));
      if (list->empty())
        problems_.add("wrong_type", place(p.name), fmt::format("\"{}\" is an empty list", p.name),
                      "give at least one number");
      return result;
    }
    std::string cure = p.kind == ParameterKind::list ? "write e.g. [1, 2] or [\"1 V\", \"2 V\"]"
                                                     : "write a number, or a number with a unit such as \"5 Hz\"";
    if (!declaration_.names_from.empty())
      cure += fmt::format("; an input is wired under \"in\": {{\"{}\": ...}}", p.name);
    problems_.add("wrong_type", place(p.name),
                  fmt::format("\"{}\" of {} is {}, found {}", p.name, declaration_.type,
                              p.kind == ParameterKind::list ? "a list of numbers" : "a number", kind_of(value)),
                  cure);
    result.numbers.push_back({});
    return result;
  }

  ResolvedParameter from_matrix(const ParameterDeclaration& p, const Value& value, const std::string& name) {
    ResolvedParameter result;
    result.list = true;
    const auto* matrix = std::get_if<NumberMatrix>(&value.content);
    if (matrix == nullptr || matrix->rows.empty() || matrix->rows.front().empty()) {
      problems_.add("wrong_type", place(p.name),
                    fmt::format("\"{}\" of {} is a matrix, found {}", p.name, declaration_.type, kind_of(value)),
                    "write its rows: [[1, 2, 3], [4, 5, 6]]; a single row is [[1, 2, 3]]");
      return result;
    }
    const std::size_t columns = matrix->rows.front().size();
    result.columns = static_cast<int>(columns);
    for (std::size_t r = 0; r < matrix->rows.size(); ++r) {
      const auto& row = matrix->rows[r];
      if (row.size() != columns)
        problems_.add(
            "bad_value", place(p.name),
            fmt::format("row {} of \"{}\" has {} numbers, the first has {}", r + 1, p.name, row.size(), columns),
            "give all rows the same length");
      for (std::size_t c = 0; c < columns; ++c)
        result.numbers.push_back(c < row.size() ? resolve(p, row[c], name, value) : ResolvedNumber{});
    }
    return result;
  }

  static std::string kind_of(const Value& value) {
    if (const auto* text = std::get_if<std::string>(&value.content)) return fmt::format("the text \"{}\"", *text);
    if (std::holds_alternative<Number>(value.content)) return "a number";
    return std::holds_alternative<NumberMatrix>(value.content) ? "an empty matrix" : "a list";
  }

  ResolvedParameter from_text(const ParameterDeclaration& p, const Value& value) {
    ResolvedParameter result;
    std::string text;
    if (const auto* given = std::get_if<std::string>(&value.content)) {
      text = *given;
    } else if (const auto written = p.choices.empty() ? written_text(value) : std::nullopt) {
      text = *written;
    } else {
      problems_.add("wrong_type", place(p.name),
                    fmt::format("\"{}\" of {} is a text, found a number", p.name, declaration_.type),
                    p.choices.empty() ? "write it in quotes" : did_you_mean("", p.choices));
      result.numbers.push_back({});
      return result;
    }
    if (p.choices.empty()) {
      for (const char c : text) {
        ResolvedNumber n;
        n.si = static_cast<double>(static_cast<unsigned char>(c));
        result.numbers.push_back(n);
      }
      return result;
    }
    ResolvedNumber n;
    for (std::size_t i = 0; i < p.choices.size(); ++i)
      if (p.choices[i] == text) {
        n.si = static_cast<double>(i);
        result.numbers.push_back(n);
        return result;
      }
    problems_.add("bad_value", place(p.name),
                  fmt::format("\"{}\" of {} cannot be \"{}\"", p.name, declaration_.type, text),
                  did_you_mean(text, p.choices));
    result.numbers.push_back(n);
    return result;
  }

  ResolvedParameter from_reference(const ParameterDeclaration& p, const Reference& reference, int depth) {
    ResolvedParameter failed;
    failed.numbers.push_back({});
    // A nested diagram's parameter may be overridden where the diagram is used; that value lives in the outer scope.
    const Scope* scope = &scope_;
    std::string name = reference.name;
    for (;; ++depth) {
      const DiagramParameter* given = scope->diagram->parameters.find(name);
      if (given == nullptr || depth > 32) {
        problems_.add("unknown_reference", place(p.name),
                      fmt::format("the diagram has no parameter \"{}\" (for \"${}\")", name, name),
                      did_you_mean(name, scope->diagram->parameters.names()));
        return failed;
      }
      const Value* value = &given->value;
      const std::string path = scope->prefix + name;
      note_used(path, given);
      const Value* outer = scope->node != nullptr ? scope->node->parameters.find(name) : nullptr;
      if (outer != nullptr) {
        value = outer;
        if (const auto* next = std::get_if<Reference>(&outer->content)) {
          scope = scope->parent;
          name = next->name;
          stands_for(path, scope->prefix + name);
          continue;
        }
      } else if (const auto* next = std::get_if<Reference>(&value->content)) {
        name = next->name;
        stands_for(path, scope->prefix + name);
        continue;
      }
      return from_value(p, *value, path, depth);
    }
  }

  void note_used(const std::string& path, const DiagramParameter* given) {
    GraphParameter& known = parameters_[path];
    if (known.given == nullptr) known = {path, given};
  }

  void stands_for(const std::string& path, const std::string& other) { parameters_[path].stands_for = other; }

  ResolvedNumber resolve(const ParameterDeclaration& p, const Number& number, const std::string& name,
                         const Value& value) {
    ResolvedNumber n;
    n.parameter = name;
    n.origin = value.origin;
    n.known_to = value.known_to;
    const std::string where = was_set(value.origin) ? value.origin : place(p.name);
    const bool variable = p.unit.find('$') != std::string::npos;
    try {
      const Unit declared = variable ? Unit{} : parse_unit(p.unit, where);
      if (!number.unit) {
        n.unit = declared;
        n.si = p.is_difference ? declared.difference_to_si(number.value) : declared.to_si(number.value);
      } else {
        n.unit = parse_unit(*number.unit, where);
        n.has_unit = true;
        n.dimension = n.unit.dimension;
        n.si = p.is_difference ? n.unit.difference_to_si(number.value) : n.unit.to_si(number.value);
        const double factor = variable ? 1 : dimension_factor(n.unit.dimension, declared.dimension);
        if (factor == 0) {
          problems_.add(
              "wrong_unit", where,
              fmt::format("\"{}\" of {} is in {}, found \"{}\"", p.name, declaration_.type,
                          p.unit.empty() ? "no unit" : p.unit, *number.unit),
              p.unit.empty() ? "leave the unit out" : fmt::format("write it in {} or a multiple of it", p.unit));
          return nobody_knows(n);
        }
        n.si *= factor;
        if (factor != 1) n.unit.scale *= factor;
      }
    } catch (const Error& e) {
      for (const auto& problem : e.problems) problems_.add(problem.code, where, problem.what, problem.cure);
      return nobody_knows(n);
    }
    check_range(p, n, where);
    if (p.is_structural && (n.si != std::floor(n.si) || std::abs(n.si) > 1e6))
      problems_.add("bad_value", where,
                    fmt::format("\"{}\" of {} holds {}, which is no whole number", p.name, declaration_.type, n.si),
                    "write whole numbers");
    return n;
  }

  // So that nothing that follows from a number without a valid unit is told as a second problem.
  static ResolvedNumber nobody_knows(ResolvedNumber n) {
    n.si = std::numeric_limits<double>::quiet_NaN();
    return n;
  }

  void check_range(const ParameterDeclaration& p, const ResolvedNumber& n, const std::string& where) {
    const double si = n.si;
    const auto in_its_unit = [&](double value) { return value_text(value, n.unit, p.is_difference); };
    if (std::isnan(si))
      problems_.add("bad_value", where, fmt::format("\"{}\" of {} is not a number", p.name, declaration_.type),
                    "give a finite number");
    else if (!lies_in_range(p, si))
      problems_.add(
          "bad_value", where,
          fmt::format("\"{}\" of {} is {}, which is outside its range", p.name, declaration_.type, in_its_unit(si)),
          !(si > p.maximum) ? fmt::format("it must be {} {}", p.exclusive_minimum ? "greater than" : "at least",
                                          in_its_unit(p.minimum))
                            : fmt::format("it must be at most {}", in_its_unit(p.maximum)));
  }

  void check_lengths(const std::vector<ResolvedParameter>& list) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto& p = declaration_.parameters[i];
      std::vector<double> numbers;
      for (const auto& n : list[i].numbers) numbers.push_back(n.si);
      const bool known = std::none_of(numbers.begin(), numbers.end(), [](double x) { return std::isnan(x); });
      if (const auto k = first_that_does_not_increase(numbers); p.is_increasing && known && k > 0)
        problems_.add("bad_value", place(p.name),
                      fmt::format("\"{}\" of {} does not increase at its element {}", p.name, declaration_.type, k + 1),
                      "sort the list, each value once");
      const int other = p.same_length_as.empty() ? -1 : declaration_.parameter_index(p.same_length_as);
      if (other >= 0 && list[static_cast<std::size_t>(other)].numbers.size() != list[i].numbers.size())
        problems_.add("bad_value", place(p.name),
                      fmt::format("\"{}\" has {} elements, \"{}\" has {}", p.name, list[i].numbers.size(),
                                  p.same_length_as, list[static_cast<std::size_t>(other)].numbers.size()),
                      "give both lists the same length");
    }
  }

  const Scope& scope_;
  const Node& node_;
  const Declaration& declaration_;
  std::string origin_;
  Ordered<GraphParameter>& parameters_;
  Problems& problems_;
};

}  // namespace

std::vector<ResolvedParameter> resolve_parameters(const Scope& scope, const Node& node, const Declaration& declaration,
                                                  const std::string& origin, Ordered<GraphParameter>& parameters,
                                                  Problems& problems) {
  return Resolver(scope, node, declaration, origin, parameters, problems).all();
}

}  // namespace hysteron
