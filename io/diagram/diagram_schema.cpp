// Decides the JSON Schema of diagrams: what docs/diagrams.md allows, with every block type and parameter from its
// declaration. An editor completes and checks by it; the reader and the engine say more (units, wires, references).
#include <fmt/format.h>

#include <algorithm>

#include "engine/simulate/simulate.h"
#include "io/diagram/diagram_file.h"
#include "io/diagram/place_kinds.h"
#include "io/json/schema_parts.h"

namespace hysteron {
namespace {

using namespace schema;

std::string parameter_description(const ParameterDeclaration& p) {
  std::string text = p.meaning;
  if (p.kind != ParameterKind::text) text += p.unit.empty() ? "; a plain number" : fmt::format(" [{}]", p.unit);
  if (p.exclusive_minimum)
    text += fmt::format("; above {}", p.minimum);
  else if (p.minimum > -std::numeric_limits<double>::infinity())
    text += fmt::format("; at least {}", p.minimum);
  if (p.maximum < std::numeric_limits<double>::infinity()) text += fmt::format("; at most {}", p.maximum);
  if (p.is_increasing) text += "; strictly increasing";
  if (!p.same_length_as.empty()) text += fmt::format("; as many as {}", p.same_length_as);
  if (p.default_text) text += fmt::format("; default {}", p.default_text->empty() ? "none" : *p.default_text);
  return text;
}

Json parameter_schema(const ParameterDeclaration& p) {
  const std::string description = parameter_description(p);
  if (p.kind == ParameterKind::text) return p.choices.empty() ? text(description) : choice_of(description, p.choices);
  if (p.kind == ParameterKind::number) return quantity(description, true);
  const char* kind = p.kind == ParameterKind::matrix ? "#/definitions/matrix" : "#/definitions/list";
  if (p.may_be_matrix)
    return {{"description", description},
            {"anyOf", Json::array({{{"$ref", kind}}, {{"$ref", "#/definitions/matrix"}}})}};
  return {{"description", description}, {"allOf", Json::array({{{"$ref", kind}}})}};
}

std::string port_text(const PortDeclaration& port) {
  return fmt::format("{} [{}]: {}{}{}", port.name, port.unit, port.meaning, port.variadic ? " (any number)" : "",
                     port.is_vector ? " (of any length)" : "");
}

std::string type_description(const Declaration& d) {
  std::string description = d.summary;
  if (!d.equation.empty()) description += "\nLaw: " + d.equation;
  for (const auto& port : d.inputs) description += "\nInput " + port_text(port);
  for (const auto& port : d.outputs) description += "\nOutput " + port_text(port);
  if (d.is_elementwise) description += "\nOn vectors it works element by element.";
  for (const auto& remark : d.remarks) description += "\n" + remark;
  if (!d.source.empty()) description += "\nSource: " + d.source;
  return description;
}

/// Everything but "in" of one block type. Required parameters may also come from a set.
Json body_of(const Declaration& d) {
  Json properties{{"type", {{"const", d.type}, {"description", type_description(d)}}}};
  properties["parameters"] = text("file with a set of parameters");
  std::vector<std::string> required;
  for (const auto& p : d.parameters) {
    properties[p.name] = parameter_schema(p);
    if (!p.default_text) required.push_back(p.name);
  }
  if (d.is_series) {
    properties["file"] = text("CSV with a column t");
    properties["column"] = text("name of the column in it");
    required.insert(required.end(), {"file", "column"});
  }
  // Whether these may stand here, the block or the choice says.
  for (const char* key : {"in", "effect", "upon"}) properties[key] = true;
  Json body{{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  if (!d.names_from.empty())  // its text names further parameters
    body["additionalProperties"] = {
        {"anyOf", Json::array({{{"$ref", "#/definitions/quantity"}}, {{"$ref", "#/definitions/list"}}})}};
  if (!required.empty()) body["anyOf"] = Json::array({{{"required", required}}, {{"required", {"parameters"}}}});
  return body;
}

/// A chain of "if the type is X, then it looks like X": an editor then speaks of the type meant, not of all that did
/// not fit.
Json by_type(const Registry& registry) {
  Json conditions = Json::array();
  for (const auto& type : registry.types()) {
    if (registry.find(type)->declaration.group == "internal") continue;
    conditions.push_back({{"if", {{"properties", {{"type", {{"const", type}}}}}, {"required", {"type"}}}},
                          {"then", {{"$ref", "#/definitions/block " + type}}}});
  }
  conditions.push_back({{"if", {{"properties", {{"type", {{"const", "diagram"}}}}}, {"required", {"type"}}}},
                        {"then", {{"$ref", "#/definitions/nested diagram"}}}});
  return conditions;
}

std::vector<std::string> type_names(const Registry& registry) {
  std::vector<std::string> names;
  for (const auto& type : registry.types())
    if (registry.find(type)->declaration.group != "internal") names.push_back(type);
  names.push_back("diagram");
  return names;
}

Json signal(const char* what) { return text(fmt::format("{}: 1 = true, 0 = false", what)); }

/// When a nested diagram runs that does not always.
Json enable() {
  const char* while_true = "the signal while which it runs";
  return {
      {"description", "it runs while a signal is true"},
      {"anyOf",
       Json::array(
           {signal(while_true),
            object(
                "the signal, and what else holds",
                {{"in", signal(while_true)},
                 {"states",
                  {{"description", "when it is enabled again they go on, or begin anew"}, {"enum", {"hold", "reset"}}}},
                 {"outputs",
                  {{"description", "while it is not enabled they stay, or are zero"}, {"enum", {"hold", "zero"}}}}},
                {"in"})})}};
}

Json trigger() {
  const char* at_edges = "the signal at whose edges it runs";
  return {{"description", "it runs once at each edge of a signal"},
          {"anyOf", Json::array({signal(at_edges), object("the signal, and which edges",
                                                          {{"in", signal(at_edges)},
                                                           {"edge",
                                                            {{"description", "rising: from false to true"},
                                                             {"enum", {"rising", "falling", "either"}}}}},
                                                          {"in"})})}};
}

Json wires() {
  const Json one = text("a signal: block, block.port, or an input of the diagram; with [0] one element of it");
  const Json some{{"anyOf", Json::array({one, list_of("several signals", one)})}};
  return {{"description", "where the inputs come from: one signal, a list in the order of the ports, or port: signal"},
          {"anyOf", Json::array({one,
                                 list_of("in the order of the ports", one),
                                 {{"type", "object"}, {"additionalProperties", some}}})}};
}

Json typed_node(const Registry& registry, bool with_inputs) {
  Json node{{"type", "object"},
            {"properties", {{"type", choice_of("type of the block", type_names(registry))}}},
            {"required", {"type"}}};
  if (with_inputs)
    node["properties"].update({{"in", {{"$ref", "#/definitions/wires"}}}, {"effect", false}, {"upon", false}});
  else
    node["properties"].update({{"in", false},
                               {"effect", text("id of the effect that put this candidate here")},
                               {"upon", text("the candidate before it that this one is, with that effect besides")}});
  node["allOf"] = by_type(registry);
  return node;
}

Json choice() {
  return object("several candidates, one of which is in use",
                {{"choose", text("name of the candidate in use")},
                 {"effect", text("id of the effect that put this choice here")},
                 {"in", {{"$ref", "#/definitions/wires"}}},
                 {"from", named("the candidates", {{"$ref", "#/definitions/candidate"}})}},
                {"choose", "from"});
}

Json diagram_parameter() {
  const Json bound{{"anyOf", Json::array({{{"$ref", "#/definitions/quantity"}}, {{"type", "null"}}})}};
  Json bounds = list_of("smallest and largest value for fits; null = no bound", bound);
  bounds["minItems"] = 2;
  bounds["maxItems"] = 2;
  Json full = object("a number of the diagram, to which blocks refer by \"$name\"",
                     {{"value", {{"type", {"number", "string", "array"}}, {"description", "the value"}}},
                      {"unit", text("its unit")},
                      {"known_to", known_to()},
                      {"bounds", std::move(bounds)},
                      {"free", {{"type", "boolean"}, {"description", "may a fit change it"}}},
                      {"remark", text("what a reader should know")}},
                     {"value"});
  return {{"anyOf", Json::array({{{"type", {"number", "string", "array"}}}, std::move(full)})}};
}

Json simulate() {
  Json solver = object(
      "how it is integrated",
      {{"method",
        choice_of(
            "auto: exact where the diagram allows it, else runge_kutta where restarts are frequent and nothing is "
            "stiff, else bdf; bdf for stiff diagrams, adams for "
            "smooth ones, runge_kutta where restarts are frequent; euler and rk4 take fixed steps",
            method_names())},
       {"relative_tolerance", number("error per step, relative")},
       {"absolute_tolerance", number("as a multiple of each state's nominal size")},
       {"max_step", quantity("longest step [s]", false)},
       {"step", quantity("step of euler and rk4 [s]", false)}});
  solver["properties"]["relative_tolerance"]["exclusiveMinimum"] = 0;
  solver["properties"]["absolute_tolerance"]["exclusiveMinimum"] = 0;
  return object("how long, how often, how exactly",
                {{"until", quantity("end [s]", false)},
                 {"every", quantity("output step [s]", false)},
                 {"solver", std::move(solver)},
                 {"loops", choice_of("what an algebraic loop is: something to solve (the default), or an error",
                                     {"solve", "error"})},
                 {"start", choice_of("given: states as declared; steady: equilibrium for the sources as they begin",
                                     {"given", "steady"})},
                 {"past",
                  {{"type", "object"},
                   {"description", "block -> what its input has been before the start, value after value"},
                   {"additionalProperties", {{"type", "array"}, {"items", {{"type", {"number", "string"}}}}}}}},
                 {"memory",
                  {{"type", "object"},
                   {"description", "block -> what it remembers at the start, number after number"},
                   {"additionalProperties", {{"type", "array"}, {"items", {{"type", {"number", "string"}}}}}}}},
                 {"guess",
                  {{"type", "object"},
                   {"description", "signals of algebraic loops, where the search for their solution begins"},
                   {"additionalProperties", quantity("value of the signal", false)}}}});
}

Json places() {
  const Json wire = text("a signal");
  const Json some{{"anyOf", Json::array({wire, list_of("signals", wire)})}};
  Json properties;
  for (const auto& kind : place_kinds) properties[kind] = some;
  return object("where effects may enter, by kind", std::move(properties));
}

void add_definitions(Json& definitions, const Registry& registry) {
  const Json element{{"$ref", "#/definitions/quantity"}};
  Json with_unit = object(
      "numbers that share a unit",
      {{"value", list_of("numbers", element)}, {"unit", {{"type", "string"}}}, {"known_to", known_to()}}, {"value"});
  definitions["list"] = {{"anyOf", Json::array({list_of("numbers, each perhaps with its unit", element),
                                                std::move(with_unit),
                                                {{"type", "string"}, {"pattern", R"(^\$[a-z][a-z0-9_]*$)"}},
                                                {{"type", "number"}}})}};
  const Json row = list_of("a row", element);
  Json plain_rows = list_of("rows of numbers", list_of("a row", {{"type", "number"}}));
  Json rows_with_unit =
      object("rows of numbers that share a unit",
             {{"value", std::move(plain_rows)}, {"unit", {{"type", "string"}}}, {"known_to", known_to()}}, {"value"});
  definitions["matrix"] = {{"anyOf", Json::array({list_of("rows of numbers, each perhaps with its unit", row),
                                                  std::move(rows_with_unit),
                                                  {{"type", "string"}, {"pattern", R"(^\$[a-z][a-z0-9_]*$)"}}})}};
  definitions["wires"] = wires();
  // "from" alone may be a parameter of a type (chirp).
  const Json from_without_type{{"required", {"from"}}, {"not", {{"required", {"type"}}}}};
  definitions["block"] = {{"if", {{"anyOf", Json::array({{{"required", {"choose"}}}, from_without_type})}}},
                          {"then", choice()},
                          {"else", typed_node(registry, true)}};
  definitions["candidate"] = typed_node(registry, false);
  Json nested{
      {"type", "object"},
      {"description", "another diagram; further keys set its parameters (kp) or those of its blocks (controller.kp)"},
      {"properties",
       {{"type", {{"const", "diagram"}}},
        {"file", text("the diagram's file")},
        {"in", true},
        {"enable", enable()},
        {"trigger", trigger()},
        {"effect", true},
        {"upon", true}}},
      {"required", {"file"}}};
  definitions["nested diagram"] = std::move(nested);
  for (const auto& type : registry.types())
    if (const auto& d = registry.find(type)->declaration; d.group != "internal")
      definitions["block " + type] = body_of(d);
}

}  // namespace

std::string diagram_schema(const Registry& registry) {
  Json json = head("hysteron diagram", "Named blocks and where each takes its inputs from.");
  add_definitions(json["definitions"], registry);
  Json properties;
  add_head_members(properties);
  properties["parameters"] = named("numbers to which blocks refer by \"$name\"", diagram_parameter());
  properties["inputs"] =
      signals("signals from outside; they bind by name to measured columns",
              object("an input", {{"unit", text("its unit")},
                                  {"length",
                                   {{"type", "integer"},
                                    {"minimum", 1},
                                    {"description", "how many numbers it carries; they bind as u[0], u[1], ..."}}},
                                  {"remark", text("what a reader should know")}}));
  properties["blocks"] = named("the blocks, in reading order", {{"$ref", "#/definitions/block"}});
  properties["outputs"] = signals("signals that are compared with measured columns of the same name", text("a signal"));
  properties["record"] = {
      {"anyOf", Json::array({text("a signal"), list_of("signals that a run writes", text("a signal"))})}};
  properties["places"] = places();
  properties["simulate"] = simulate();
  json.update(
      object("Named blocks and where each takes its inputs from.", std::move(properties), {"format", "blocks"}));
  return to_text(json);
}

}  // namespace hysteron
