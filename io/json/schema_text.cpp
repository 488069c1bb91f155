#include "io/json/schema_text.h"

#include <nlohmann/json.hpp>

namespace hysteron::schema {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t line_width = 120;

void print(const Json& json, std::size_t indent, std::size_t used, std::string& out) {
  const std::string line = json.dump(-1, ' ', false);
  if (!json.is_structured() || json.empty() || used + line.size() <= line_width) {
    // dump() writes no spaces; a schema is read by people too.
    if (!json.is_structured()) {
      out += line;
      return;
    }
    out += json.is_object() ? '{' : '[';
    bool first = true;
    for (const auto& item : json.items()) {
      if (!first) out += ", ";
      first = false;
      if (json.is_object()) out += Json(item.key()).dump() + ": ";
      print(item.value(), indent, 0, out);
    }
    out += json.is_object() ? '}' : ']';
    return;
  }
  out += json.is_object() ? '{' : '[';
  bool first = true;
  for (const auto& item : json.items()) {
    if (!first) out += ',';
    first = false;
    out += '\n' + std::string(indent + 2, ' ');
    const std::string key = json.is_object() ? Json(item.key()).dump() + ": " : "";
    out += key;
    print(item.value(), indent + 2, indent + 2 + key.size() + 20,
          out);  // 20: room for the spaces that dump() leaves out
  }
  out += '\n' + std::string(indent, ' ') + (json.is_object() ? '}' : ']');
}

}  // namespace

std::string to_text(const Json& schema) {
  std::string out;
  print(schema, 0, 0, out);
  return out + '\n';
}

}  // namespace hysteron::schema
