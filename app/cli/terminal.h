// Decides how texts and tables are laid out in a terminal of 100 columns.
// Does not know what they say.
#pragma once

#include <string>
#include <vector>

namespace hysteron {

inline constexpr std::size_t terminal_width = 100;

/// Breaks text into lines of at most 100 columns, each behind `indent` spaces; ends with a newline. Line ends of the
/// text stay.
std::string wrapped(const std::string& text, std::size_t indent = 0);

/// Columns aligned under their heads, two spaces apart; the last column is wrapped. Empty `heads` = no head line.
std::string table_text(const std::vector<std::string>& heads, const std::vector<std::vector<std::string>>& rows,
                       std::size_t indent = 2);

}  // namespace hysteron
