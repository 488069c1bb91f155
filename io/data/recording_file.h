// Decides what one measured file says: its times and columns in SI, complete and in order.
// Does not know what a data set says of it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/diagram/units.h"
#include "io/data/csv.h"
#include "io/formats/measured_table.h"

namespace hysteron {

struct RecordingFile {
  std::string file;
  std::vector<double> t;                               ///< [s] strictly increasing
  std::vector<std::string> names;                      ///< of the columns other than t, in the order of the file
  std::map<std::string, std::vector<double>> columns;  ///< [SI]
  std::map<std::string, Unit> units;                   ///< as written
  std::vector<std::string> assumed;                    ///< of a foreign file: what was assumed to read it
};

/// " Units stand in square brackets: t [ms]" where a column is called "t (ms)" and "t" is looked for; else "".
std::string bracket_hint(const std::string& name, const std::vector<std::string>& columns);

/// Throws Error "bad_number" for values beyond 1e100, which no instrument gives and whose squares are no numbers.
void check_sizes(const CsvTable& table);

/// Throws Error "decreasing_time" where times stand twice, go back, or were written with too few digits, and
/// "rows_too_near"; "missing_column" and "wrong_unit" where there is no column t in a unit of time.
void check_times(const CsvTable& table);

/// Reads a recording: a table of ours (table_file.h) with a column t and at least `fewest_rows` rows. Throws Error
/// what check_sizes(), check_times() and read_table() throw, and "too_few_rows".
RecordingFile read_recording_file(const std::string& file, std::size_t fewest_rows);

/// The same of a file of any format (measured_file.h).
RecordingFile read_measured_recording(const std::string& file, std::size_t fewest_rows, const ReadingChoices& choices);

}  // namespace hysteron
