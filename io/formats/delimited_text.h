// Decides how the text of an instrument or a laboratory is read: CSV and its relatives, whatever stands above the table
// and between its cells.
#pragma once

#include <string>

#include "io/formats/measured_table.h"

namespace hysteron {

/// Reads a file of text.
MeasuredTable read_delimited_text(const std::string& file, const ReadingChoices& choices);
/// Reads a text that was made of `file`, in UTF-8. Throws as read_measured_table() does (file_format.h).
MeasuredTable read_delimited_text(const std::string& file, const std::string& text, const ReadingChoices& choices);

}  // namespace hysteron
