#include "io/data/binary_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "io/files/atomic_file.h"
#include "io/files/digest.h"

namespace hysteron {
namespace {

using Json = nlohmann::ordered_json;

// Numbers go to the file as they lie in memory.
static_assert(std::endian::native == std::endian::little && sizeof(double) == 8);

constexpr char begins_with[] = R"({"hysteron_f64":)";
constexpr int newest_format = 1;
constexpr std::uint64_t head_in_steps_of = 64;   // [byte] so that its length settles, and columns are aligned
constexpr std::size_t longest_head = 256 << 20;  // [byte] more is damage: the head is kept in memory

std::string_view bytes_of(const std::vector<double>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double)};
}

std::string digest_of(const std::vector<double>& numbers) {
  Digest digest;
  const auto bytes = bytes_of(numbers);
  digest.add(bytes.data(), bytes.size());
  return digest.text();
}

std::uint64_t ceil_divide(std::uint64_t n, std::uint64_t by) { return (n + by - 1) / by; }

/// Rows of each level above `rows` rows, until one has no more than a screen shows.
std::vector<std::uint64_t> rows_of_levels(std::uint64_t rows) {
  std::vector<std::uint64_t> levels;
  for (std::uint64_t n = rows; n > pyramid_factor; levels.push_back(n)) n = ceil_divide(n, pyramid_factor);
  return levels;
}

enum class Side { low, high };

double outer(Side side, double a, double b) { return side == Side::low ? std::fmin(a, b) : std::fmax(a, b); }

/// The smallest (largest) of every `stride` numbers.
std::vector<double> thinned(std::span<const double> numbers, std::uint64_t stride, Side side) {
  std::vector<double> outermost;
  outermost.reserve(ceil_divide(numbers.size(), stride));
  while (!numbers.empty()) {
    const auto together = numbers.first(std::min<std::size_t>(stride, numbers.size()));
    double found = together.front();
    for (const double x : together.subspan(1)) found = outer(side, found, x);
    outermost.push_back(found);
    numbers = numbers.subspan(together.size());
  }
  return outermost;
}

/// The first line of the file, if it were `size` bytes long.
std::string head_text(const CsvTable& table, const std::vector<std::string>& digests, std::uint64_t size) {
  const auto levels = rows_of_levels(table.rows());
  std::uint64_t at = size;
  const auto place = [&](std::uint64_t rows) {
    const std::uint64_t begin = at;
    at += rows * sizeof(double);
    return begin;
  };
  Json columns = Json::array();
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    columns.push_back({{"name", table.columns[c].name},
                       {"unit", table.columns[c].unit.text},
                       {"at", place(table.rows())},
                       {"digest", digests[c]}});
  for (auto& column : columns) {
    column["low"] = Json::array();
    column["high"] = Json::array();
    for (const auto rows : levels) {
      column["low"].push_back(place(rows));
      column["high"].push_back(place(rows));
    }
  }
  Json pyramid = Json::array();
  std::uint64_t stride = 1;
  for (const auto rows : levels) pyramid.push_back({{"stride", stride *= pyramid_factor}, {"rows", rows}});
  const Json head{{"hysteron_f64", newest_format},
                  {"rows", table.rows()},
                  {"bytes", at},
                  {"columns", columns},
                  {"pyramid", pyramid}};
  return head.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// The same, padded to its own length, of which the places in it depend.
std::string head_line(const CsvTable& table) {
  std::vector<std::string> digests;
  for (const auto& column : table.columns) {
    look_up();
    digests.push_back(digest_of(column.values));
  }
  for (std::uint64_t size = 0;;) {
    std::string text = head_text(table, digests, size);
    if (text.size() < size) {
      text.resize(size - 1, ' ');
      return text + '\n';
    }
    size = head_in_steps_of * ceil_divide(text.size() + 1, head_in_steps_of);
  }
}

void check_lengths(const std::string& file, const CsvTable& table) {
  for (const auto& column : table.columns)
    if (column.values.size() != table.rows())
      fail(
          "row_length", file,
          fmt::format("column \"{}\" has {} values, the first has {}", column.name, column.values.size(), table.rows()),
          "give every column one value per row");
}

}  // namespace

bool is_binary_table(const std::string& file) {
  if (file.ends_with(binary_table_type)) return true;
  std::string begin(std::string_view(begins_with).size(), '\0');
  std::ifstream(file, std::ios::binary).read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin == begins_with;
}

void write_binary_table(const std::string& file, const CsvTable& table) {
  check_lengths(file, table);
  UnfinishedFile unfinished(file);
  unfinished.append(head_line(table));
  for (const auto& column : table.columns) unfinished.append(bytes_of(column.values));
  for (const auto& column : table.columns) {
    std::vector<double> low, high;
    std::span<const double> lows(column.values), highs(column.values);
    while (lows.size() > pyramid_factor) {
      lows = low = thinned(lows, pyramid_factor, Side::low);
      highs = high = thinned(highs, pyramid_factor, Side::high);
      unfinished.append(bytes_of(low));
      unfinished.append(bytes_of(high));
    }
  }
  unfinished.finish();
}

CsvTable read_binary_table(const std::string& file) {
  BinaryTable binary(file);
  CsvTable table;
  table.file = file;
  Problems problems;
  for (std::size_t c = 0; c < binary.columns().size(); ++c) {
    look_up();
    const auto& head = binary.columns()[c];
    std::vector<double> values = binary.read(c, 0, binary.rows());
    if (digest_of(values) != head.digest)
      fail("damaged_file", file, fmt::format("column \"{}\" of {} is not what was written", head.name, file),
           "take the file from where it was copied, or compute it again");
    const auto bad = std::find_if_not(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    if (bad != values.end())
      problems.add("bad_number", head.name,
                   fmt::format("column \"{}\" holds {} in row {} of {}, a finite number was expected", head.name, *bad,
                               bad - values.begin() + 1, file),
                   "cut the table there: nothing is filled in silently");
    table.columns.push_back({head.name, head.unit, std::move(values)});
  }
  problems.throw_if_any();
  table.lines.resize(table.rows());
  for (std::size_t i = 0; i < table.lines.size(); ++i) table.lines[i] = static_cast<int>(i) + 1;
  return table;
}

BinaryTable::BinaryTable(const std::string& file) : file_(file) {
  check_readable(file);
  stream_.open(file, std::ios::binary | std::ios::ate);
  bytes_ = stream_ ? static_cast<std::uint64_t>(stream_.tellg()) : 0;
  stream_.seekg(0);
  try {
    read_head();
  } catch (const nlohmann::json::exception& e) {
    damaged(fmt::format("its first line cannot be read ({})", e.what()));
  }
}

void BinaryTable::damaged(const std::string& why) const {
  fail("damaged_file", file_, fmt::format("{} is no table of columns: {}", file_, why),
       "take the file from where it was copied, or compute it again");
}

void BinaryTable::read_head() {
  std::string line(std::string_view(begins_with).size(), '\0');
  stream_.read(line.data(), static_cast<std::streamsize>(line.size()));
  if (!stream_ || line != begins_with) damaged(fmt::format("it does not begin with {}", begins_with));
  for (char c = 0; stream_.get(c) && c != '\n' && line.size() < longest_head;) line += c;
  const std::uint64_t size = line.size() + 1;
  const Json head = Json::parse(line);
  if (const int format = head.at("hysteron_f64").get<int>(); format > newest_format)
    fail("newer_format", file_, fmt::format("format {} was written by a newer hysteron", format),
         fmt::format("read it with that version; this one reads formats up to {}", newest_format));
  rows_ = head.at("rows").get<std::uint64_t>();
  const auto written = head.at("bytes").get<std::uint64_t>();
  if (bytes_ != written) damaged(fmt::format("it has {} bytes, {} were written", bytes_, written));
  const auto place = [&](const Json& at, std::uint64_t rows) {
    const auto begin = at.get<std::uint64_t>();
    if (begin < size || begin > bytes_ || rows > (bytes_ - begin) / sizeof(double))
      damaged("its first line names places that are not in it");
    return begin;
  };
  level_rows_ = rows_of_levels(rows_);
  for (const auto& item : head.at("columns")) {
    Column column{item.at("name"), {}, place(item.at("at"), rows_), item.at("digest"), {}, {}};
    if (const std::string unit = item.at("unit"); !unit.empty()) column.unit = parse_unit(unit, column.name);
    if (item.at("low").size() != level_rows_.size() || item.at("high").size() != level_rows_.size())
      damaged("levels of its pyramid are missing");
    for (std::size_t l = 0; l < level_rows_.size(); ++l) {
      column.low.push_back(place(item["low"][l], level_rows_[l]));
      column.high.push_back(place(item["high"][l], level_rows_[l]));
    }
    columns_.push_back(std::move(column));
  }
  if (columns_.empty() || rows_ == 0) fail("empty_file", file_, "the file holds no row", "compute it again");
}

std::vector<double> BinaryTable::numbers(std::uint64_t at, std::uint64_t count) {
  std::vector<double> values(count);
  stream_.clear();
  stream_.seekg(static_cast<std::streamoff>(at));
  stream_.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(double)));
  if (!stream_) damaged("it ends before its columns do");
  return values;
}

std::vector<double> BinaryTable::read(std::size_t column, std::uint64_t first, std::uint64_t last) {
  last = std::min(last, rows_);
  return first < last ? numbers(columns_[column].at + first * sizeof(double), last - first) : std::vector<double>{};
}

Envelope BinaryTable::envelope(std::size_t column, std::uint64_t first, std::uint64_t last, std::size_t most) {
  last = std::min(last, rows_);
  Envelope e{first, std::max(first, last), 1, {}, {}};
  if (first >= last || most == 0) return e;
  // The coarsest level of which `most` stretches can still be made.
  std::size_t level = 0;
  while (level < level_rows_.size() && (last - first) / (e.stride * pyramid_factor) >= most) {
    e.stride *= pyramid_factor;
    ++level;
  }
  const std::uint64_t begin = first / e.stride, end = ceil_divide(last, e.stride);
  const std::uint64_t together = ceil_divide(end - begin, most);
  e.first = begin * e.stride;
  e.last = std::min(end * e.stride, rows_);
  e.stride *= together;
  const Column& c = columns_[column];
  const auto part = [&](std::uint64_t at) { return numbers(at + begin * sizeof(double), end - begin); };
  e.low = thinned(part(level == 0 ? c.at : c.low[level - 1]), together, Side::low);
  e.high = thinned(part(level == 0 ? c.at : c.high[level - 1]), together, Side::high);
  return e;
}

}  // namespace hysteron
