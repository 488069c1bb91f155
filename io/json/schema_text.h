// Decides how a JSON Schema is laid out in its file. Does not know what it says.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace hysteron::schema {

/// Indented text; objects and lists that fit stay on one line.
std::string to_text(const nlohmann::ordered_json& schema);

}  // namespace hysteron::schema
