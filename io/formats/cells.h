// Decides how a line of a table is cut into cells, and what a cell says: a number, nothing, a time of day, a word.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hysteron {

/// How the numbers of a text stand: ' ' separates by any run of blanks and tabs.
struct CellForm {
  char separator = ',';
  char decimal = '.';
};

std::string_view without_blanks(std::string_view text);  ///< at both ends, no-break spaces too
std::string lower_case_of(std::string_view text);        ///< ASCII letters

/// The cells of a line, without blanks and quotes around them. A separator within quotes is part of its cell.
void split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells);

/// "1.5", "-2e-3", "1,5" and "1.234,5" with a decimal comma; nothing where it is no finite number. What stands in
/// groups of three digits is read where both signs tell which is which.
std::optional<double> cell_number(std::string_view cell, char decimal);

/// Whether a cell says that there is no value: empty, "---", "NaN", "n/a".
bool says_no_value(std::string_view cell);
/// Whether a cell says that the range was left: "OL", "OVLD", "∞".
bool says_overload(std::string_view cell);
/// Numbers by which instruments say the same (SCPI: 9.9E37 is an overflow, 9.91E37 no number).
bool is_overload(double value);

/// A time of day, with or without a date: "2026-05-04T13:37:00.005Z", "04.05.2026 13:37:00,005", "13:37:00.5 PM".
struct ClockTime {
  std::int64_t nanoseconds = 0;  ///< since 1970, or since midnight where there is no date
  bool has_date = false, has_clock = false;
  bool order_unclear = false;  ///< "05/04/2026": read as day 4 of May; others write the day first
};
std::optional<ClockTime> clock_time(std::string_view cell);

}  // namespace hysteron
