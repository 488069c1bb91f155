// Decides what one measured file says: its times and columns in SI, complete and in order.
// Does not know what a data set says of it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/diagram/units.h"
#include "io/data/csv.h"

namespace hysteron {

struct RecordingFile {
  std::string file;
  std::vector<double> t;                               ///< [s] strictly increasing
  std::vector<std::string> names;                      ///< of the columns other than t, in the order of the file
  std::map<std::string, std::vector<double>> columns;  ///< [SI]
  std::map<std::string, Unit> units;                   ///< as written
};

/// " Units stand in square brackets: t [ms]" where a column is called "t (ms)" and "t" is looked for; else "".
std::string bracket_hint(const std::string& name, const std::vector<std::string>& columns);

/// Throws Error "bad_number" for values beyond 1e100, which no instrument gives and whose squares are no numbers.
void check_sizes(const CsvTable& table);

/// Reads a recording: a table (table_file.h) with a column t and at least `fewest_rows` rows. Throws Error
/// "missing_column", "wrong_unit", "decreasing_time", "too_few_rows", "unknown_file_type" and what read_table throws.
RecordingFile read_recording_file(const std::string& file, std::size_t fewest_rows);

}  // namespace hysteron
