// Decides in which of our two forms a table of numbers is read and written: text (csv.h), or numbers as they lie in
// memory (binary_table.h).
#pragma once

#include <string>

#include "io/data/csv.h"

namespace hysteron {

/// Reads a table, whatever its form. Throws what read_csv() and read_binary_table() throw.
CsvTable read_table(const std::string& file);

/// Writes a table in the form that the name of the file asks for: ".f64", else CSV.
void write_table(const std::string& file, const CsvTable& table);

}  // namespace hysteron
