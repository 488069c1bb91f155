// Decides whether a file satisfies a schema that the project ships, by an independent validator.
#pragma once

#include <string>

namespace hysteron::schema {

/// "" if `json_text` is valid under schema/<name>.schema.json, else what the validator says.
std::string refuses(const std::string& name, const std::string& json_text);

}  // namespace hysteron::schema
