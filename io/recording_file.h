// Decides what one measured file says: its times and columns in SI, complete and in order.
// Does not know what a data set says of it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/units.h"

namespace hysteron {

struct RecordingFile {
  std::string file;
  std::vector<double> t;                               ///< [s] strictly increasing
  std::vector<std::string> names;                      ///< of the columns other than t, in the order of the file
  std::map<std::string, std::vector<double>> columns;  ///< [SI]
  std::map<std::string, Unit> units;                   ///< as written
};

/// Reads a recording: CSV with a column t and at least `fewest_rows` rows. Throws Error "missing_column", "wrong_unit",
/// "decreasing_time", "too_few_rows", "unknown_file_type" and what read_csv throws.
RecordingFile read_recording_file(const std::string& file, std::size_t fewest_rows);

}  // namespace hysteron
