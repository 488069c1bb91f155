// Decides how places are written: JSON pointers, and lines and columns of a text.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace hysteron {

/// "/blocks" + "a/b" = "/blocks/a~1b" (RFC 6901).
std::string pointer_to(const std::string& parent, std::string_view key);

/// Line and column, both 1-based, of a byte of a text.
std::pair<int, int> line_and_column(std::string_view text, std::size_t byte);

}  // namespace hysteron
