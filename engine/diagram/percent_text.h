// Decides how a path of files is written in a link.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace hysteron {

/// "a%20b/c.csv" of "a b/c.csv": all but the unreserved characters of RFC 3986 (section 2.3) and the slash, byte by
/// byte.
inline std::string percent_encoded(std::string_view path) {
  std::string text;
  for (const char c : path) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '/' ||
                       c == '-' || c == '.' || c == '_' || c == '~';
    text += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return text;
}

}  // namespace hysteron
