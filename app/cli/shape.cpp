#include "app/cli/shape.h"

#include <utility>

namespace hysteron::shape {
namespace {

Facts of_type(Facts type, const std::string& meaning) {
  return Facts::object({{"type", std::move(type)}, {"description", meaning}});
}

}  // namespace

Facts text(const std::string& meaning) { return of_type("string", meaning); }
Facts whole(const std::string& meaning) { return of_type("integer", meaning); }
Facts number(const std::string& meaning) { return of_type(std::vector<std::string>{"number", "null"}, meaning); }
Facts flag(const std::string& meaning) { return of_type("boolean", meaning); }
Facts open_object(const std::string& meaning) { return of_type("object", meaning); }

Facts choice(const std::string& meaning, const std::vector<std::string>& values) {
  return Facts::object({{"enum", values}, {"description", meaning}});
}

Facts list(const std::string& meaning, Facts item) {
  Facts shape = of_type("array", meaning);
  shape.set("items", std::move(item));
  return shape;
}

Facts texts(const std::string& meaning) { return list(meaning, Facts::object({{"type", "string"}})); }

Facts object(const std::string& meaning, const std::vector<Member>& members) {
  Facts properties = Facts::object({});
  std::vector<std::string> required;
  for (const auto& member : members) {
    properties.set(member.name, member.value);
    if (!member.sometimes) required.push_back(member.name);
  }
  Facts shape = of_type("object", meaning);
  shape.set("properties", std::move(properties));
  if (!required.empty()) shape.set("required", required);
  shape.set("additionalProperties", false);
  return shape;
}

Facts named(const std::string& meaning, Facts member) {
  Facts shape = of_type("object", meaning);
  shape.set("additionalProperties", std::move(member));
  return shape;
}

std::vector<Member> published(std::vector<Member> own, bool may_be_missing) {
  std::vector<Member> members{{"headline", text("the answer in one sentence"), may_be_missing},
                              {"verdict", text("adequate, missing_effect, not_distinguishable, unexplained"), true},
                              {"folder", text("where the results lie"), may_be_missing},
                              {"result", text("its result.json, which holds all of it"), may_be_missing}};
  for (auto& member : own) members.push_back(std::move(member));
  return members;
}

}  // namespace hysteron::shape
