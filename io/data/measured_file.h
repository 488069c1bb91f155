// Decides how the file of an instrument becomes a table as ours are: a first column t, units that are known, complete
// rows. Says all that it assumed. Does not read formats (io/formats) and does not judge the times (recording_file.h).
#pragma once

#include <string>
#include <vector>

#include "io/data/csv.h"
#include "io/formats/measured_table.h"

namespace hysteron {

struct MeasuredFile {
  CsvTable table;                      ///< t [s, ms ...] and the other columns, as written (not SI)
  bool as_it_stands = false;           ///< the file is a table of ours already: nothing was assumed
  std::vector<std::string> assumed{};  ///< in words, one fact each
};

/// Reads a measured file of any format (io/formats/file_format.h) or a table of ours (table_file.h). Rows in which a
/// column has no value are left out and told. Throws Error what both throw, and "missing_column", "ambiguous_time",
/// "no_time", "bad_unit", "ambiguous_unit", "sparse_column", each with the option that chooses.
MeasuredFile read_measured_file(const std::string& file, const ReadingChoices& choices = {});

/// The columns of a reader as a table of ours; part of the above, for tests.
MeasuredFile finished(MeasuredTable measured, const ReadingChoices& choices);

}  // namespace hysteron
