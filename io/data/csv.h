// Decides how a table of numbers is read from and written to CSV (RFC 4180, one header line, # comments).
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/diagram/name_index.h"
#include "engine/diagram/units.h"

namespace hysteron {

struct CsvColumn {
  std::string name;            ///< without the unit
  Unit unit;                   ///< from "name [unit]"; dimensionless where none is written
  std::vector<double> values;  ///< as written (not SI)
};

struct CsvTable {
  std::string file;
  std::vector<CsvColumn> columns;
  std::vector<int> lines;  ///< line of each row in the file, 1-based, for messages
  std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
  const CsvColumn* find(const std::string& name) const;  ///< the first of that name, or null; of any number of them

  /// What find() keeps, once it was asked: names of so many columns.
  struct Names {
    std::size_t columns = 0;
    NameIndex index{};
  };
  mutable std::shared_ptr<const Names> names{};
};

/// Reads a CSV. Throws Error naming file, line and column: "no_file", "is_directory", "empty_file", "no_header",
/// "bad_number" (text, NaN, infinity or an empty cell), "row_length", "duplicate_column", "bad_unit".
CsvTable read_csv(const std::string& file);

/// Whether the text begins with the header of such a file that holds a recording: names apart by commas, units in
/// square brackets that are known, and a column t in a unit of time.
bool has_plain_header(std::string_view text);

/// A cell of a CSV: between quotes, those inside doubled, where it would not be read as written else.
std::string csv_cell(const std::string& text);

/// The text of a CSV. Throws Error "row_length"; Stopped (engine/diagram/stop.h).
std::string csv_text(const CsvTable& table, const std::vector<std::string>& comments = {});

/// Writes a CSV, whole or not at all (temporary file, then rename; a device such as /dev/full fails with
/// "cannot_write"). Ends early where work is asked to stop (engine/diagram/stop.h).
void write_csv(const std::string& file, const CsvTable& table, const std::vector<std::string>& comments = {});

}  // namespace hysteron
