#include "io/json/schema_parts.h"

namespace hysteron::schema {
namespace {

constexpr const char* number_pattern = R"(^[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?( .*|[^0-9 ].*)?$)";

}  // namespace

Json text(const std::string& description) { return {{"type", "string"}, {"description", description}}; }
Json number(const std::string& description) { return {{"type", "number"}, {"description", description}}; }

Json flag(const char* meaning) { return {{"type", "boolean"}, {"description", meaning}}; }

Json choice_of(const std::string& description, const std::vector<std::string>& values) {
  return {{"enum", values}, {"description", description}};
}

Json quantity(const std::string& description, bool reference) {
  // In draft-07 what stands beside $ref is ignored, hence allOf.
  const char* kind = reference ? "#/definitions/value" : "#/definitions/quantity";
  return {{"description", description}, {"allOf", Json::array({{{"$ref", kind}}})}};
}

Json list_of(const std::string& description, Json items) {
  return {{"type", "array"}, {"description", description}, {"items", std::move(items)}};
}

Json known_to() {
  return {{"anyOf", Json::array({{{"type", "number"}, {"minimum", 0}, {"maximum", 1}},
                                 {{"type", "string"}, {"pattern", R"(^[0-9.eE+-]+ *%?$)"}}})},
          {"description", "how well it is known: one standard deviation as a part of it, \"2 %\" or 0.02; 0 = exact"}};
}

Json object(const std::string& description, Json properties, const std::vector<std::string>& required) {
  Json json{{"type", "object"}, {"description", description}, {"properties", std::move(properties)}};
  if (!required.empty()) json["required"] = required;
  json["additionalProperties"] = false;
  return json;
}

Json named(const std::string& description, Json member) {
  return {{"type", "object"},
          {"description", description},
          {"propertyNames", {{"pattern", "^[a-z][a-z0-9_]*$"}}},
          {"additionalProperties", std::move(member)}};
}

Json signals(const std::string& description, Json member) {
  Json json = named(description, std::move(member));
  json["propertyNames"]["pattern"] = "^[A-Za-z][A-Za-z0-9_]*$";
  return json;
}

Json head(const std::string& title, const std::string& description) {
  Json json{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}, {"description", description}};
  Json with_unit =
      object("a number with its unit", {{"value", {{"type", "number"}}}, {"unit", {{"type", "string"}}}}, {"value"});
  Json with_more =
      object("a number, with its unit and how well it is known",
             {{"value", {{"type", {"number", "string"}}}}, {"unit", {{"type", "string"}}}, {"known_to", known_to()}},
             {"value"});
  Json quantity_text{
      {"type", "string"}, {"pattern", number_pattern}, {"description", "a number with its unit: \"5 Hz\""}};
  Json value_text{{"type", "string"},
                  {"pattern", std::string(R"(^\$[a-z][a-z0-9_]*$|)") + number_pattern},
                  {"description", "a number with its unit, or \"$name\" of a parameter of the diagram"}};
  json["definitions"] = {
      {"quantity", {{"anyOf", Json::array({{{"type", "number"}}, quantity_text, with_unit})}}},
      {"value", {{"anyOf", Json::array({{{"type", "number"}}, value_text, with_more})}}},
  };
  return json;
}

void add_head_members(Json& properties) {
  properties["$schema"] = text("the schema of this file, for editors");
  properties["format"] = {{"const", 1}, {"description", "format of this file"}};
  properties["title"] = text("what it is, for the head of a report");
  properties["source"] = text("where it comes from: a paper, a figure, a laboratory");
  properties["remark"] = text("what a reader should know");
}

}  // namespace hysteron::schema
