// Decides what a reader of a foreign file gives back: columns of numbers with the names and units that stand in the
// file, and in words all that it assumed. Does not know which column drives, nor whether the rows are any good.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hysteron {

/// What stands for a value that the file does not have: an empty cell, a mark of overload.
inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

struct MeasuredColumn {
  std::string name;
  std::string unit{};  ///< as the file writes it; "" = none is written
  std::vector<double> values{};
};

/// Rows that stand at equal distances, where the file says how far apart instead of when.
struct SampleClock {
  double start = 0;     ///< [s]
  double interval = 0;  ///< [s], above 0
};

struct MeasuredTable {
  std::string file;
  std::vector<MeasuredColumn> columns;
  std::vector<int> lines;            ///< line of each row in the file, 1-based; empty: row k is line k
  std::optional<std::size_t> time;   ///< the column of the times, where the layout of the file says so
  std::optional<SampleClock> clock;  ///< where the file says the distance of its samples
  std::vector<std::string> assumed;  ///< one fact each: "decimal comma", "14 lines above the header"

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
};

/// What a user says of a file where it leaves something open.
struct ReadingChoices {
  std::string time{};                          ///< the column of the times
  std::optional<double> interval{};            ///< [s] rows are so far apart, whatever the file says
  std::map<std::string, std::string> units{};  ///< unit by column
  bool units_may_miss = false;                 ///< columns of `units` need not be there
  std::vector<std::string> without{};          ///< columns to leave out
  std::vector<std::string> names{};            ///< headings, for a file that has none: "u [V]"
  std::string decimal{};                       ///< "point", "comma"; "" = as the file looks
  std::string sheet{};                         ///< of a workbook; "" = its first
  std::string group{};                         ///< of a file that holds several tables
};

}  // namespace hysteron
