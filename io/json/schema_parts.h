// Decides the pieces that several JSON Schemas share: numbers with units, names, the head of a file. Internal to io.
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/json/schema_text.h"

namespace hysteron::schema {

using Json = nlohmann::ordered_json;

Json text(const std::string& description);
Json number(const std::string& description);
Json flag(const char* meaning);
Json choice_of(const std::string& description, const std::vector<std::string>& values);
/// 5, "5 Hz", {"value": 5, "unit": "Hz"}; with `reference` also "$name".
Json quantity(const std::string& description, bool reference);
Json list_of(const std::string& description, Json items);
/// How well a number is known: 0.02, "2 %".
Json known_to();
/// An object with exactly these members.
Json object(const std::string& description, Json properties, const std::vector<std::string>& required = {});
/// An object whose member names match [a-z][a-z0-9_]* and whose members all look like `member`.
Json named(const std::string& description, Json member);
/// The same for inputs and outputs, which are called as measured columns are.
Json signals(const std::string& description, Json member);

/// The head of a schema: draft, title, and the definitions that quantity() refers to.
Json head(const std::string& title, const std::string& description);
/// Members that every file of ours has: $schema, format, title, source, remark.
void add_head_members(Json& properties);

}  // namespace hysteron::schema
