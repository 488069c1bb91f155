// Decides how a table of millions of rows stands in one file that others read without this program (docs/programs.md):
// one line of JSON that says where everything lies, the columns as little-endian float64, and for every 64, 64^2 ...
// rows the smallest and the largest value, so that any stretch is drawn at once. Does not know what the columns mean.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "io/data/csv.h"

namespace hysteron {

inline constexpr char binary_table_type[] = ".f64";  ///< how its name ends
inline constexpr std::uint64_t pyramid_factor = 64;  ///< rows of one level that are one row of the next

/// By its name, or by how it begins. False where there is no such file.
bool is_binary_table(const std::string& file);

/// Writes the table, whole or not at all. Of NaN the pyramid takes no notice. Throws Error "row_length",
/// "cannot_write"; Stopped (engine/diagram/stop.h).
void write_binary_table(const std::string& file, const CsvTable& table);

/// Reads all of it; CsvTable::lines holds numbers of rows, from 1. Throws Error "damaged_file" also where a number is
/// not the one that was written, "bad_number" where it is not finite, and what BinaryTable throws.
CsvTable read_binary_table(const std::string& file);

/// Smallest and largest values of a column over neighbouring stretches of rows.
struct Envelope {
  std::uint64_t first = 0;   ///< row with which the first stretch begins
  std::uint64_t last = 0;    ///< row behind the last one
  std::uint64_t stride = 1;  ///< rows of each stretch; the last may be shorter
  std::vector<double> low, high;
};

/// An open file, of which no more is read than what is asked for. For one thread at a time.
class BinaryTable {
 public:
  struct Column {
    std::string name;
    Unit unit;
    std::uint64_t at = 0;                  ///< [byte] where its rows begin
    std::string digest;                    ///< of its bytes (io/files/digest.h)
    std::vector<std::uint64_t> low, high;  ///< [byte] where each level of the pyramid begins
  };

  /// Throws Error "no_file", "damaged_file" (a head that cannot be read, a length that is not the one it says),
  /// "newer_format", "bad_unit".
  explicit BinaryTable(const std::string& file);

  const std::vector<Column>& columns() const { return columns_; }
  std::uint64_t rows() const { return rows_; }

  /// Rows [first, last) of one column, as written (not SI).
  std::vector<double> read(std::size_t column, std::uint64_t first, std::uint64_t last);

  /// At most `most` stretches that hold the rows [first, last), by reading hardly more than 64 numbers for each. Where
  /// the rows are more than that, stretches begin at whole rows of the pyramid: the first and the last may reach
  /// beyond.
  Envelope envelope(std::size_t column, std::uint64_t first, std::uint64_t last, std::size_t most);

 private:
  void read_head();
  std::vector<double> numbers(std::uint64_t at, std::uint64_t count);
  [[noreturn]] void damaged(const std::string& why) const;

  std::string file_;
  std::ifstream stream_;
  std::uint64_t bytes_ = 0, rows_ = 0;
  std::vector<std::uint64_t> level_rows_;
  std::vector<Column> columns_;
};

}  // namespace hysteron
