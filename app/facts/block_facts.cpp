#include "app/facts/block_facts.h"

#include <cmath>

namespace hysteron {
namespace {

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

}  // namespace

std::string kind_name(ParameterKind kind) {
  return kind == ParameterKind::list     ? "list"
         : kind == ParameterKind::text   ? "text"
         : kind == ParameterKind::matrix ? "matrix"
                                         : "number";
}

Facts block_facts(const Declaration& d) {
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
    Facts null_value = Facts::object({});
    for (const auto& [parameter, value] : v.null_value) null_value.set(parameter, value);
    variations.push_back(Facts::object({{"name", v.name}, {"type", v.type}, {"neutral", null_value}}));
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

std::vector<shape::Member> block_shape() {
  using namespace shape;
  const Facts port = object("a port", {{"name", text("in \"in\", or behind the block's name")},
                                       {"unit", text("$a stands for any")},
                                       {"meaning", text("what it is")},
                                       {"any_number", flag("of wires")},
                                       {"vector", flag("of any length")}});
  const Facts parameter =
      object("a parameter", {{"name", text("as diagrams write it")},
                             {"unit", text("empty: none")},
                             {"meaning", text("what it is")},
                             {"kind", choice("of value", {"number", "list", "text", "matrix"})},
                             {"default", Facts::object({{"type", std::vector<std::string>{"string", "null"}}})},
                             {"choices", texts("of a text: the words it may be")},
                             {"minimum", number("in SI")},
                             {"exclusive_minimum", flag("it must be above")},
                             {"maximum", number("in SI")},
                             {"linear", flag("found by linear least squares")}});
  const Facts state = object("a continuous state", {{"name", text("")}, {"unit", text("")}, {"meaning", text("")}});
  const Facts variation = object("a richer law with the same ports",
                                 {{"name", text("")},
                                  {"type", text("the block type that has it")},
                                  {"neutral", named("values that change nothing", text("a quantity"))}});
  return {{"type", text("as diagrams write it")},
          {"summary", text("what it is")},
          {"group", text("of blocks")},
          {"law", text("its equation")},
          {"source", text("of the law")},
          {"remarks", texts("what a reader should know")},
          {"inputs", list("ports", port)},
          {"outputs", list("ports", port)},
          {"parameters", list("in their order", parameter)},
          {"states", list("continuous ones", state)},
          {"elementwise", flag("works on vectors, element by element")},
          {"sampled", flag("runs at instants")},
          {"variations", list("of its law", variation)},
          {"memory", object("what it remembers", {{"unit_of", text("a port")}, {"meaning", text("")}}), sometimes}};
}

}  // namespace hysteron
