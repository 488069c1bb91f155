// The verb blocks: documentation of the block types, from the declarations that the checker uses.
// Does not know any block.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/cli/block_words.h"
#include "app/cli/load.h"
#include "app/cli/terminal.h"
#include "app/cli/verb.h"
#include "engine/diagram/error.h"
#include "report/pages/facts.h"
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

void print_all() {
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
    fmt::print("{}\n{}\n", group, table_text({}, rows));
  }
  fmt::print(
      "\"hysteron blocks TYPE\" shows one in full. Besides these, \"type\": \"diagram\" with \"file\" puts\n"
      "one diagram into another.\n");
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

std::string kind_name(ParameterKind kind) {
  return kind == ParameterKind::list     ? "list"
         : kind == ParameterKind::text   ? "text"
         : kind == ParameterKind::matrix ? "matrix"
                                         : "number";
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

void print_ports(const std::string& title, const std::vector<PortDeclaration>& ports) {
  if (ports.empty()) return;
  TableRows rows;
  for (const auto& p : ports)
    rows.push_back({p.name + (p.variadic && title == "outputs" ? "0, " + p.name + "1, ..." : ""), unit_column(p.unit),
                    p.meaning + (p.variadic && title == "inputs" ? " (any number of wires)" : "") +
                        (p.is_vector ? " (any length)" : "")});
  fmt::print("\n{}\n{}", title, table_text({}, rows));
}

void print_memory(const Declaration& d) {
  if (d.memory_port.empty()) return;
  fmt::print("\nmemory\n{}",
             wrapped(fmt::format("{}, in the unit of {}; \"simulate\": {{\"memory\": {{\"name\": [...]}}}} "
                                 "gives it at the start",
                                 d.memory_meaning, d.memory_port),
                     2));
}

/// "coulomb 0 N, breakaway 0 N"
std::string neutral_text(const VariationDeclaration& variation) {
  std::vector<std::string> parts;
  for (const auto& [parameter, value] : variation.neutral) parts.push_back(parameter + " " + value);
  return fmt::format("{}", fmt::join(parts, ", "));
}

void print_variations(const Declaration& d) {
  if (d.variations.empty()) return;
  TableRows rows;
  for (const auto& v : d.variations)
    rows.push_back({v.name, v.type == d.type ? "this type" : v.type, "no change with " + neutral_text(v)});
  fmt::print("\nvariations (same ports, further parameters)\n{}", table_text({}, rows));
}

Facts port_facts(const std::vector<PortDeclaration>& ports) {
  Facts::List list;
  for (const auto& p : ports)
    list.push_back(Facts::object({{"name", p.name},
                                  {"unit", p.unit},
                                  {"meaning", p.meaning},
                                  {"any_number", p.variadic},
                                  {"vector", p.is_vector}}));
  return list;
}

Facts finite_or_null(double bound) { return std::isfinite(bound) ? Facts(bound) : Facts(); }

/// All that print_one() says, for programs.
Facts facts_of(const Declaration& d) {
  Facts::List parameters, states, variations;
  for (const auto& p : d.parameters)
    parameters.push_back(Facts::object({{"name", p.name},
                                        {"unit", p.unit},
                                        {"meaning", p.meaning},
                                        {"kind", kind_name(p.kind)},
                                        {"default", p.default_text ? Facts(*p.default_text) : Facts()},
                                        {"choices", p.choices},
                                        {"minimum", finite_or_null(p.minimum)},
                                        {"exclusive_minimum", p.exclusive_minimum},
                                        {"maximum", finite_or_null(p.maximum)},
                                        {"linear", p.is_linear}}));
  for (const auto& s : d.states)
    states.push_back(Facts::object({{"name", s.name}, {"unit", s.unit}, {"meaning", s.meaning}}));
  for (const auto& v : d.variations) {
    Facts neutral = Facts::object({});
    for (const auto& [parameter, value] : v.neutral) neutral.set(parameter, value);
    variations.push_back(Facts::object({{"name", v.name}, {"type", v.type}, {"neutral", neutral}}));
  }
  Facts facts = Facts::object({{"type", d.type},
                               {"summary", d.summary},
                               {"group", d.group},
                               {"law", d.equation},
                               {"source", d.source},
                               {"remarks", d.remarks},
                               {"inputs", port_facts(d.inputs)},
                               {"outputs", port_facts(d.outputs)},
                               {"parameters", parameters},
                               {"states", states},
                               {"elementwise", d.is_elementwise},
                               {"sampled", d.is_sampled},
                               {"variations", variations}});
  if (!d.memory_port.empty())
    facts.set("memory", Facts::object({{"unit_of", d.memory_port}, {"meaning", d.memory_meaning}}));
  return facts;
}

void print_one(const Declaration& d) {
  fmt::print("{}", wrapped(fmt::format("{}: {} [{}]", d.type, d.summary, d.group)));
  if (!d.equation.empty()) fmt::print("\nlaw\n{}", wrapped(d.equation, 2));
  print_ports("inputs", d.inputs);
  print_ports("outputs", d.outputs);
  if (!d.parameters.empty()) {
    TableRows rows;
    for (const auto& p : d.parameters)
      rows.push_back({p.name, p.kind == ParameterKind::text ? "" : unit_column(p.unit), kind_column(p), conditions(p)});
    fmt::print("\nparameters\n{}", table_text({}, rows));
  }
  if (!d.states.empty()) {
    TableRows rows;
    for (const auto& s : d.states) rows.push_back({s.name, unit_column(s.unit), s.meaning});
    fmt::print("\nstates\n{}", table_text({}, rows));
  }
  print_memory(d);
  print_variations(d);
  if (d.is_elementwise)
    fmt::print("\n{}",
               wrapped("On vectors it works element by element, with the same parameters for all; single numbers "
                       "go to every element."));
  if (!d.remarks.empty()) {
    fmt::print("\nremarks\n");
    for (const auto& remark : d.remarks) fmt::print("{}", wrapped(remark, 2));
  }
  if (!d.source.empty()) fmt::print("\nsource\n{}", wrapped(d.source, 2));
  fmt::print("\nexample\n{}", wrapped(example(d), 2));
  const auto variable = [](const auto& item) { return item.unit.find('$') != std::string::npos; };
  if (std::any_of(d.inputs.begin(), d.inputs.end(), variable) ||
      std::any_of(d.outputs.begin(), d.outputs.end(), variable))
    fmt::print("\n{}", wrapped("$a, $b stand for units that come from the wires and from the units written at the "
                               "parameters; $a[i] for that of each element."));
}

int blocks(const Arguments& arguments) {
  if (!arguments.has("type")) {
    if (arguments.has("--json")) {
      Facts::List list;
      for (const auto& type : shown_types()) list.push_back(facts_of(registry().find(type)->declaration));
      fmt::print("{}\n", json_text(list));
    } else {
      print_all();
    }
    return exit_code::done;
  }
  const std::string type = arguments.text("type");
  const Kernel* kernel = registry().find(type);
  if (kernel == nullptr) fail("unknown_block", type, "there is no block type \"" + type + "\"", instead_of_type(type));
  if (arguments.has("--json"))
    fmt::print("{}\n", json_text(facts_of(kernel->declaration)));
  else
    print_one(kernel->declaration);
  return exit_code::done;
}

}  // namespace

Verb blocks_verb() {
  return {"blocks",
          "which blocks are there, and what does one do",
          blocks_help,
          {{"type", "TYPE", "the block type to show in full", false, false},
           {"--json", "", "as JSON, for programs", false, false}},
          blocks};
}

}  // namespace hysteron
