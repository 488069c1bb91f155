// The verb blocks: documentation of the block types, from the declarations that the checker uses.
// Does not know any block.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/cli/answer.h"
#include "app/cli/block_words.h"
#include "app/cli/load.h"
#include "app/cli/shape.h"
#include "app/cli/terminal.h"
#include "app/facts/block_facts.h"
#include "engine/diagram/error.h"
#include "report/pages/numbers.h"

namespace hysteron {
namespace {

constexpr char blocks_help[] =
    "Answers: which blocks are there, and what does one of them do - law, ports, parameters, units.\n\n"
    "Examples:\n"
    "  hysteron blocks                      all types, by group\n"
    "  hysteron blocks prandtl_ishlinskii   one type in full, with an example\n"
    "  hysteron blocks tank --json          the same for programs\n\n"
    "Prints to the terminal, writes no files.\n"
    "Exit codes: 0 done, 2 there is no such block.";

using TableRows = std::vector<std::vector<std::string>>;

std::vector<std::string> shown_types() {
  std::vector<std::string> types;
  for (const auto& type : registry().types())
    if (registry().find(type)->declaration.group != "internal") types.push_back(type);
  return types;
}

std::string all_text() {
  std::string text;
  std::vector<std::string> groups;
  for (const auto& type : shown_types()) {
    const auto& group = registry().find(type)->declaration.group;
    if (std::find(groups.begin(), groups.end(), group) == groups.end()) groups.push_back(group);
  }
  for (const auto& group : groups) {
    TableRows rows;
    for (const auto& type : shown_types()) {
      const auto& declaration = registry().find(type)->declaration;
      if (declaration.group == group) rows.push_back({type, declaration.summary});
    }
    text += fmt::format("{}\n{}\n", group, table_text({}, rows));
  }
  return text +
         "\"hysteron blocks TYPE\" shows one in full. Besides these, \"type\": \"diagram\" with \"file\" puts\n"
         "one diagram into another.\n";
}

std::string unit_column(const UnitExpression& unit) { return unit.empty() ? "1" : unit; }

/// What a checker would say of a parameter, in brackets behind its meaning.
std::string conditions(const ParameterDeclaration& p) {
  std::vector<std::string> list;
  if (p.exclusive_minimum && p.minimum == 0)
    list.emplace_back("positive");
  else if (p.minimum == 0)
    list.emplace_back("not negative");
  else if (std::isfinite(p.minimum))
    list.push_back("at least " + number_text(p.minimum) + (p.unit.empty() ? "" : " (SI)"));
  if (std::isfinite(p.maximum)) list.push_back("at most " + number_text(p.maximum) + (p.unit.empty() ? "" : " (SI)"));
  if (p.is_increasing) list.emplace_back("increasing");
  if (!p.same_length_as.empty()) list.push_back("as many as " + p.same_length_as);
  if (p.is_linear) list.emplace_back("found by linear least squares");
  if (!p.choices.empty()) list.push_back(fmt::format("one of {}", fmt::join(p.choices, ", ")));
  return list.empty() ? p.meaning : fmt::format("{} ({})", p.meaning, fmt::join(list, "; "));
}

std::string kind_column(const ParameterDeclaration& p) {
  const std::string kind = kind_name(p.kind);
  if (!p.default_text) return kind + ", required";
  return kind + ", default " + (p.default_text->empty() ? "\"\"" : *p.default_text);
}

/// A list that rises, and one as long as that, shows two numbers; where a matrix has a row for each, one.
bool shows_two(const ParameterDeclaration& p, const Declaration& d) {
  const auto rises = [&](const ParameterDeclaration& q) {
    return q.is_increasing && (&q == &p || q.name == p.same_length_as);
  };
  return std::any_of(d.parameters.begin(), d.parameters.end(), rises) &&
         std::none_of(d.parameters.begin(), d.parameters.end(),
                      [](const ParameterDeclaration& q) { return q.kind == ParameterKind::matrix; });
}

std::string example_value(const ParameterDeclaration& p, const Declaration& d) {
  const bool plain = p.unit.empty() || p.unit.find('$') != std::string::npos;
  const auto number = [&](int n) { return plain ? std::to_string(n) : fmt::format("\"{} {}\"", n, p.unit); };
  const std::string one = number(1);
  if (p.kind == ParameterKind::matrix) return "[[1, 0], [0, 1]]";
  if (p.kind == ParameterKind::list)
    return shows_two(p, d) ? fmt::format("[{}, {}]", one, number(p.is_increasing ? 2 : 1)) : fmt::format("[{}]", one);
  return p.kind == ParameterKind::text ? fmt::format("\"{}\"", p.choices.empty() ? "..." : p.choices.front()) : one;
}

/// One line of a diagram with every required parameter.
std::string example(const Declaration& d) {
  std::string text = fmt::format("\"name\": {{\"type\": \"{}\"", d.type);
  for (const auto& p : d.parameters)
    if (!p.default_text) text += fmt::format(", \"{}\": {}", p.name, example_value(p, d));
  if (d.inputs.size() == 1) {
    text += d.inputs[0].variadic ? ", \"in\": [\"one_signal\", \"another\"]" : ", \"in\": \"some_signal\"";
  } else if (!d.inputs.empty()) {
    std::vector<std::string> ports;
    for (const auto& port : d.inputs) ports.push_back(fmt::format("\"{}\": \"some_signal\"", port.name));
    text += fmt::format(", \"in\": {{{}}}", fmt::join(ports, ", "));
  }
  return text + "}";
}

std::string ports_text(const std::string& title, const std::vector<PortDeclaration>& ports) {
  if (ports.empty()) return "";
  TableRows rows;
  for (const auto& p : ports)
    rows.push_back({p.name + (p.variadic && title == "outputs" ? "0, " + p.name + "1, ..." : ""), unit_column(p.unit),
                    p.meaning + (p.variadic && title == "inputs" ? " (any number of wires)" : "") +
                        (p.is_vector ? " (any length)" : "")});
  return fmt::format("\n{}\n{}", title, table_text({}, rows));
}

std::string memory_text(const Declaration& d) {
  if (d.memory_port.empty()) return "";
  return "\nmemory\n" + wrapped(fmt::format("{}, in the unit of {}; \"simulate\": {{\"memory\": {{\"name\": [...]}}}} "
                                            "gives it at the start",
                                            d.memory_meaning, d.memory_port),
                                2);
}

/// "coulomb 0 N, breakaway 0 N"
std::string neutral_text(const VariationDeclaration& variation) {
  std::vector<std::string> parts;
  for (const auto& [parameter, value] : variation.null_value) parts.push_back(parameter + " " + value);
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string variations_text(const Declaration& d) {
  if (d.variations.empty()) return "";
  TableRows rows;
  for (const auto& v : d.variations)
    rows.push_back({v.name, v.type == d.type ? "this type" : v.type, "no change with " + neutral_text(v)});
  return "\nvariations (same ports, further parameters)\n" + table_text({}, rows);
}

std::string one_text(const Declaration& d) {
  std::string text = wrapped(fmt::format("{}: {} [{}]", d.type, d.summary, d.group));
  if (!d.equation.empty()) text += "\nlaw\n" + wrapped(d.equation, 2);
  text += ports_text("inputs", d.inputs);
  text += ports_text("outputs", d.outputs);
  if (!d.parameters.empty()) {
    TableRows rows;
    for (const auto& p : d.parameters)
      rows.push_back({p.name, p.kind == ParameterKind::text ? "" : unit_column(p.unit), kind_column(p), conditions(p)});
    text += "\nparameters\n" + table_text({}, rows);
  }
  if (!d.states.empty()) {
    TableRows rows;
    for (const auto& s : d.states) rows.push_back({s.name, unit_column(s.unit), s.meaning});
    text += "\nstates\n" + table_text({}, rows);
  }
  text += memory_text(d);
  text += variations_text(d);
  if (d.is_elementwise)
    text += "\n" + wrapped(
                       "Works element by element on vectors, with the same parameters for all elements; a scalar input "
                       "applies to every element.");
  if (!d.remarks.empty()) {
    text += "\nremarks\n";
    for (const auto& remark : d.remarks) text += wrapped(remark, 2);
  }
  if (!d.source.empty()) text += "\nsource\n" + wrapped(d.source, 2);
  text += "\nexample\n" + wrapped(example(d), 2);
  const auto variable = [](const auto& item) { return item.unit.find('$') != std::string::npos; };
  if (std::any_of(d.inputs.begin(), d.inputs.end(), variable) ||
      std::any_of(d.outputs.begin(), d.outputs.end(), variable))
    text += "\n" + wrapped(
                       "$a, $b stand for units that follow from the wires and from the units of the parameters; $a[i] "
                       "for the unit of each element.");
  return text;
}

Answer blocks(const Arguments& arguments, const Watch&) {
  Answer answer;
  if (!arguments.has("type")) {
    Facts::List list;
    for (const auto& type : shown_types()) list.push_back(block_facts(registry().find(type)->declaration));
    answer.text = all_text();
    answer.facts = Facts::object({{"blocks", list}});
    return answer;
  }
  const std::string type = arguments.text("type");
  const Kernel* kernel = registry().find(type);
  if (kernel == nullptr) fail("unknown_block", type, "there is no block type \"" + type + "\"", instead_of_type(type));
  answer.text = one_text(kernel->declaration);
  answer.facts = block_facts(kernel->declaration);
  return answer;
}

/// Of one type its members, else all types.
std::vector<shape::Member> blocks_shape() {
  auto members = block_shape();
  const Facts one = shape::object("a block type", members);
  for (auto& member : members) member.sometimes = true;
  members.push_back({"blocks", shape::list("all types, where none was named", one), shape::sometimes});
  return members;
}

}  // namespace

Verb blocks_verb() {
  return {"blocks",    "which blocks are there, and what does one do",
          blocks_help, {{"type", "TYPE", "the block type to show in full", false, false}},
          blocks,      blocks_shape};
}

}  // namespace hysteron
