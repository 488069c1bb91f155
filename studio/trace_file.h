// Decides what the page gets of a file of traces: the columns, and for a stretch of time smallest and largest value per
// pixel, however many rows there are. Does not draw.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "io/data/csv.h"

namespace hysteron::studio {

struct TraceStretch {
  double from = 0, to = 0;  ///< of the first column, in its unit; from >= to: all of it
  std::size_t pixels = 1000;
};

/// Files of traces that were read; the last few stay in memory.
class TraceFiles {
 public:
  TraceFiles();
  ~TraceFiles();

  /// {"rows", "from", "to", "columns": [{"name", "unit"}]}. Throws as read_table().
  nlohmann::ordered_json head(const std::string& file);

  /// float64, little-endian: n; n values of the first column; then for each of `columns` n smallest and n largest
  /// values. Throws Error "unknown_column".
  std::string stretch(const std::string& file, const std::vector<std::string>& columns, const TraceStretch& wanted);

  /// The same of a table in memory.
  static std::string stretch_of(const CsvTable& table, const std::vector<std::string>& columns,
                                const TraceStretch& wanted);

 private:
  struct Table;
  std::shared_ptr<Table> table(const std::string& file);

  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Table>> tables_;
  std::vector<std::string> order_;  ///< of use, the oldest first
};

}  // namespace hysteron::studio
