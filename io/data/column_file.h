// Decides how columns of millions of rows stand in a file: HDF5, one dataset per column with its unit and meaning,
// facts about all of it as attributes. The same content gives the same bytes: no times, no names of machines. Written
// whole or not at all, row by row, so that no more than a few thousand rows are in memory. Does not know what the
// columns mean.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace hysteron {

struct ColumnHead {
  std::string name;  ///< "/" stands as ":" in the name of the dataset
  std::string unit{}, meaning{};
  bool whole = false;  ///< whole numbers (of at most 53 bits)
};

using FileFact = std::variant<std::string, std::int64_t, std::vector<std::int64_t>>;
/// In the order in which they are written.
using FileFacts = std::vector<std::pair<std::string, FileFact>>;

/// Several may be open in several threads. Numbers that changed on the disk are refused by whoever reads them (the
/// library's Fletcher checksums).
class ColumnWriter {
 public:
  /// Writes beside `file` (UnfinishedFile in atomic_file.h) until finish(). Throws Error "cannot_write", "no_hdf5".
  ColumnWriter(std::string file, std::vector<ColumnHead> columns);
  /// Without finish() nothing is left.
  ~ColumnWriter();
  ColumnWriter(const ColumnWriter&) = delete;
  ColumnWriter& operator=(const ColumnWriter&) = delete;

  /// One number per column.
  void append(std::span<const double> row);
  /// On the disk, under its name. `sealed`: seal_of() tells later whether anything in it has changed.
  void finish(const FileFacts& facts, bool sealed = false);

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

class ColumnReader {
 public:
  /// Throws Error "no_file", "damaged_file" (no HDF5, or not written by a ColumnWriter), "no_hdf5".
  explicit ColumnReader(const std::string& file);
  ~ColumnReader();
  ColumnReader(const ColumnReader&) = delete;
  ColumnReader& operator=(const ColumnReader&) = delete;

  const std::vector<ColumnHead>& columns() const;
  std::uint64_t rows() const;
  /// A fact, or `otherwise` where there is none of that kind.
  std::string text(const std::string& fact, const std::string& otherwise = "") const;
  std::int64_t whole(const std::string& fact, std::int64_t otherwise = 0) const;
  std::vector<std::int64_t> list(const std::string& fact) const;
  /// Rows [first, first + count) of one column.
  void read(std::size_t column, std::uint64_t first, std::span<double> values) const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace hysteron
