// Decides how a text of numbers is laid out: where its table begins, which sign separates its cells, which one is the
// decimal sign. Judged by the rows themselves; what the rows leave open is an error that names the option.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/formats/cells.h"

namespace hysteron {

struct TextLayout {
  CellForm form;
  std::size_t begin = 0;    ///< line with which the numbers begin
  std::size_t cells = 0;    ///< of each row, those that are always empty included
  std::size_t skipped = 0;  ///< cells at the begin of a row that belong to what stands beside the table
};

std::vector<std::string_view> lines_of(std::string_view text);

/// Empty, or a comment.
bool says_nothing(std::string_view line);

/// Whether every cell is a number, a time, or says that there is none; and one at least is a number or a time.
bool are_numbers(const std::vector<std::string_view>& cells, char decimal);

/// `decimal`: "point", "comma" or "" for as it looks. Throws Error "no_table", "ambiguous_decimal".
TextLayout layout_of(const std::string& file, const std::vector<std::string_view>& lines, const std::string& decimal);

/// "tab", ";" ... for sentences.
std::string separator_text(char separator);

}  // namespace hysteron
