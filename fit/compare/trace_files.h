// Decides which columns of two CSV files are compared with each other, over which axis and under which tolerance.
// Does not measure distances (trace_distance.h) nor read the files (io/data/csv.h).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fit/compare/trace_distance.h"
#include "fit/compare/trace_tolerance.h"
#include "io/data/csv.h"

namespace hysteron {

struct TracePair {
  std::string first, second;                ///< columns; where nothing else was said both have the same name
  Unit unit{};                              ///< in which the pair is shown: that of the first file
  TraceLine first_line, second_line;        ///< SI, in their order along the axis
  std::optional<WrittenTolerance> written;  ///< none: not judged
  TraceDistance distance;
};

struct TraceComparison {
  std::string axis;  ///< "t", or what --over names
  Unit axis_unit{};  ///< of the first file
  TraceCourse course = TraceCourse::rising;
  std::vector<TracePair> pairs;
  std::vector<std::string> remarks;  ///< rows that had to be put in order, columns that only one file has
  bool within() const;
};

struct TraceWishes {
  std::string over;                                        ///< "" = the time t
  std::vector<std::pair<std::string, std::string>> pairs;  ///< columns compared; empty: all that both files have
  std::vector<WrittenTolerance> tolerances;                ///< of those for all and those for one the last that fits
};

/// Throws Error "missing_column", "nothing_to_compare", "wrong_unit", "no_overlap", "unknown_signal" with the cure.
TraceComparison compare_trace_files(const CsvTable& first, const CsvTable& second, const TraceWishes& wishes);

}  // namespace hysteron
