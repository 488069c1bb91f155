#include "studio/trace_file.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/diagram/error.h"
#include "io/data/binary_table.h"
#include "io/data/table_file.h"

namespace hysteron::studio {
namespace {

constexpr std::size_t most_tables = 24;  // kept in memory: those of CSV files whole
constexpr std::size_t most_pixels = 20000;

void append(std::string& bytes, const std::vector<double>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
}

}  // namespace

/// One of both forms: numbers in memory, or a file of which no more is read than what is asked for.
struct TraceFiles::Table {
  explicit Table(const std::string& file) : changed(std::filesystem::last_write_time(file)) {
    if (is_binary_table(file)) {
      binary.emplace(file);
      for (const auto& c : binary->columns()) names.push_back(c.name), units.push_back(c.unit.text);
      rows = binary->rows();
    } else {
      take(read_table(file));
    }
  }
  explicit Table(CsvTable table) { take(std::move(table)); }

  void take(CsvTable table) {
    text = std::move(table);
    for (const auto& c : text.columns) names.push_back(c.name), units.push_back(c.unit.text);
    rows = text.rows();
  }

  double at(std::size_t column, std::uint64_t row) {
    return binary ? binary->read(column, row, row + 1).front() : text.columns[column].values[row];
  }

  /// The first row at which the first column is at least (or, `behind`, above) this.
  std::uint64_t row_of(double value, bool behind) {
    std::uint64_t low = 0, high = rows;
    while (low < high) {
      const std::uint64_t middle = low + (high - low) / 2;
      const double here = at(0, middle);
      (behind ? here <= value : here < value) ? low = middle + 1 : high = middle;
    }
    return low;
  }

  Envelope envelope(std::size_t column, std::uint64_t first, std::uint64_t last, std::size_t most) {
    if (binary) return binary->envelope(column, first, last, most);
    const auto& values = text.columns[column].values;
    Envelope envelope{first, last, (last - first + most - 1) / most, {}, {}};
    envelope.stride = std::max<std::uint64_t>(envelope.stride, 1);
    for (std::uint64_t row = first; row < last; row += envelope.stride) {
      const auto begin = values.begin() + static_cast<long>(row);
      const auto end = values.begin() + static_cast<long>(std::min(row + envelope.stride, last));
      const auto [low, high] = std::minmax_element(begin, end);
      envelope.low.push_back(*low);
      envelope.high.push_back(*high);
    }
    return envelope;
  }

  std::string stretch(const std::vector<std::string>& columns, const TraceStretch& wanted);

  std::mutex mutex;
  std::filesystem::file_time_type changed{};
  std::optional<BinaryTable> binary{};
  CsvTable text{};
  std::vector<std::string> names{}, units{};
  std::uint64_t rows = 0;
};

TraceFiles::TraceFiles() = default;
TraceFiles::~TraceFiles() = default;

std::shared_ptr<TraceFiles::Table> TraceFiles::table(const std::string& file) {
  const std::lock_guard lock(mutex_);
  const auto known = tables_.find(file);
  std::error_code error;
  if (known != tables_.end() && known->second->changed == std::filesystem::last_write_time(file, error)) {
    std::rotate(std::find(order_.begin(), order_.end(), file), std::find(order_.begin(), order_.end(), file) + 1,
                order_.end());
    return known->second;
  }
  auto made = std::make_shared<Table>(file);
  std::erase(order_, file);
  order_.push_back(file);
  tables_[file] = made;
  if (order_.size() > most_tables) {
    tables_.erase(order_.front());
    order_.erase(order_.begin());
  }
  return made;
}

nlohmann::ordered_json TraceFiles::head(const std::string& file) {
  const auto table = this->table(file);
  const std::lock_guard lock(table->mutex);
  nlohmann::ordered_json columns = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < table->names.size(); ++i)
    columns.push_back({{"name", table->names[i]}, {"unit", table->units[i]}});
  nlohmann::ordered_json head{{"rows", table->rows}, {"from", nullptr}, {"to", nullptr}, {"columns", columns}};
  if (table->rows > 0) head["from"] = table->at(0, 0), head["to"] = table->at(0, table->rows - 1);
  return head;
}

std::string TraceFiles::Table::stretch(const std::vector<std::string>& columns, const TraceStretch& wanted) {
  std::uint64_t first = 0, last = rows;
  if (wanted.from < wanted.to) {  // and a row beyond either end, so that the line goes on to the border
    first = row_of(wanted.from, false);
    last = row_of(wanted.to, true);
    if (first > 0) --first;
    if (last < rows) ++last;
  }
  const std::size_t most = std::clamp<std::size_t>(wanted.pixels, 1, most_pixels);
  std::string bytes;
  if (first == last) {
    append(bytes, {0.0});
    return bytes;
  }
  const Envelope times = envelope(0, first, last, most);
  append(bytes, {static_cast<double>(times.low.size())});
  append(bytes, times.low);
  for (const auto& name : columns) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      fail("unknown_column", name, "there is no column \"" + name + "\"", did_you_mean(name, names));
    const Envelope values = envelope(static_cast<std::size_t>(found - names.begin()), first, last, most);
    append(bytes, values.low);
    append(bytes, values.high);
  }
  return bytes;
}

std::string TraceFiles::stretch(const std::string& file, const std::vector<std::string>& columns,
                                const TraceStretch& wanted) {
  const auto table = this->table(file);
  const std::lock_guard lock(table->mutex);
  return table->stretch(columns, wanted);
}

std::string TraceFiles::stretch_of(const CsvTable& table, const std::vector<std::string>& columns,
                                   const TraceStretch& wanted) {
  return Table(table).stretch(columns, wanted);
}

}  // namespace hysteron::studio
