// Decides how a test counts what a page says.
#pragma once

#include <string>

namespace hysteron {

/// How often `part`, which is not empty, stands in `text`.
inline std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

}  // namespace hysteron
