// Decides whether a file can be read as text. Does not know what stands in it.
#pragma once

#include <string>
#include <string_view>

namespace hysteron {

/// Throws Error "not_utf8" for a text in UTF-16, as spreadsheets and editors write where they say "Unicode".
void refuse_utf16(const std::string& file, std::string_view text);

}  // namespace hysteron
