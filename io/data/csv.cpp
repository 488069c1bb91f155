#include "io/data/csv.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "engine/diagram/error.h"
#include "engine/diagram/number_text.h"
#include "engine/diagram/stop.h"
#include "io/files/atomic_file.h"
#include "io/files/encoding.h"
#include "io/formats/file_format.h"
#include "io/formats/heading.h"

namespace hysteron {
namespace {

constexpr std::size_t problems_until_giving_up = 20;  // a file of text would otherwise fill the memory with messages

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

struct Field {
  std::string_view text;
  bool quoted = false;
};

/// Splits a text into records of fields (RFC 4180), without copying; lines that begin with # and empty lines are
/// skipped.
class Records {
 public:
  explicit Records(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // byte order mark
  }

  /// The next record where it is a row of numbers and nothing else, which is what nearly all of them are: one for each
  /// of `row`. False where it is anything else, or the end; then next() tells.
  bool next_numbers(std::vector<double>& row, int& line) {
    const char* at = text_.data() + at_;
    const char* const end = text_.data() + text_.size();
    const auto skip_blanks = [&] {
      while (at < end && (*at == ' ' || *at == '\t')) ++at;
    };
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0 && (at == end || *at++ != ',')) return false;
      skip_blanks();
      const auto [behind, status] = std::from_chars(at, end, row[i]);
      if (status != std::errc{} || !std::isfinite(row[i])) return false;
      at = behind;
      skip_blanks();
    }
    if (at < end && *at == '\r') ++at;
    if (at < end && *at != '\n') return false;
    line = line_;
    if (at < end) ++line_, ++at;
    at_ = static_cast<std::size_t>(at - text_.data());
    return true;
  }

  /// No more than that many rows are still to come.
  std::size_t most_rows(std::size_t cells) const {
    const auto rest = text_.substr(std::min(at_, text_.size()));
    const auto lines = static_cast<std::size_t>(std::count(rest.begin(), rest.end(), '\n')) + 1;
    return std::min(lines, rest.size() / (2 * std::max(cells, std::size_t{1})) + 1);
  }

  /// The next record; false at the end. `line` is where it begins.
  bool next(std::vector<Field>& fields, int& line) {
    skip_comments();
    if (at_ >= text_.size()) return false;
    fields.clear();
    line = line_;
    while (true) {
      fields.push_back(field());
      if (at_ >= text_.size()) return true;
      const char c = text_[at_++];
      if (c == ',') continue;
      end_line(c);
      return true;
    }
  }

 private:
  void end_line(char c) {
    if (c == '\r' && at_ < text_.size() && text_[at_] == '\n') ++at_;
    ++line_;
  }

  void skip_comments() {
    while (at_ < text_.size()) {
      const auto end = std::min(text_.find_first_of("\r\n", at_), text_.size());
      const auto content = trimmed(text_.substr(at_, end - at_));
      if (!content.empty() && content.front() != '#') return;
      at_ = end;
      if (at_ < text_.size()) end_line(text_[at_++]);
    }
  }

  Field field() {
    std::size_t begin = at_;
    while (begin < text_.size() && (text_[begin] == ' ' || text_[begin] == '\t')) ++begin;
    if (begin < text_.size() && text_[begin] == '"') return quoted_field(begin);
    at_ = std::min(text_.find_first_of(",\r\n", at_), text_.size());
    return {trimmed(text_.substr(begin, at_ - std::min(begin, at_))), false};
  }

  /// The text between the quotes, doubled quotes still doubled; what stands behind the closing quote stays part of the
  /// field and makes it a bad number.
  Field quoted_field(std::size_t begin) {
    std::size_t end = begin + 1;
    while (end < text_.size()) {
      if (text_[end] == '\n') ++line_;
      if (text_[end] == '"') {
        if (end + 1 < text_.size() && text_[end + 1] == '"') {
          ++end;
        } else {
          break;
        }
      }
      ++end;
    }
    const std::size_t behind = std::min(end + 1, text_.size());
    at_ = std::min(text_.find_first_of(",\r\n", behind), text_.size());
    if (!trimmed(text_.substr(behind, at_ - behind)).empty()) return {text_.substr(begin, at_ - begin), false};
    return {trimmed(text_.substr(begin + 1, end - begin - 1)), true};
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

std::string unquoted(const Field& field) {
  std::string text;
  for (std::size_t i = 0; i < field.text.size(); ++i) {
    text += field.text[i];
    if (field.quoted && field.text[i] == '"') ++i;
  }
  return text;
}

/// A finite number, locale or not. Too small ones are subnormal or zero.
bool parse_number(std::string_view text, double& value) {
  const std::size_t length = read_number(text, value);
  return length > 0 && length == text.size() && std::isfinite(value);
}

/// "y [um]" as name and unit; "tilt[1]" is an element of a vector, "tilt[1] [V]" one with a unit.
struct PlainHeading {
  std::string name, unit;
  bool has_unit = false;
};
PlainHeading plain_heading(const std::string& heading) {
  const auto open = heading.rfind('[');
  const bool is_index = open != heading.npos && open > 0 && heading[open - 1] != ' ' && open + 2 < heading.size() &&
                        heading.find_first_not_of("0123456789", open + 1) == heading.size() - 1;
  if (open == heading.npos || heading.back() != ']' || is_index) return {std::string(trimmed(heading)), "", false};
  const std::string_view text = heading;
  return {std::string(trimmed(text.substr(0, open))),
          std::string(trimmed(text.substr(open + 1, text.size() - open - 2))), true};
}

/// A file that holds no text is named as what it is.
void refuse_binary(const std::string& file, std::string_view text) {
  const auto begin = text.substr(0, 8192);
  if (begin.find('\0') == begin.npos) return;
  const KnownFile known = known_file(begin, file);
  throw Error(
      Fault::input,
      {{"unknown_file_type", file,
        known.what.empty() ? "this is not a text file" : fmt::format("this is {}, not a CSV", known.what),
        known.cure.empty() ? "export the columns as CSV with a header t [s],u [V],y [um]" : known.cure, file, 0}});
}

class Reader {
 public:
  explicit Reader(const std::string& file) : text_(read_file(file)), records_(text_) {
    table_.file = file;
    refuse_utf16(file, text_);
    refuse_binary(file, text_);
  }

  CsvTable read() {
    header();
    std::vector<double> numbers(table_.columns.size());
    const std::size_t most = records_.most_rows(numbers.size());
    table_.lines.reserve(most);
    for (auto& column : table_.columns) column.values.reserve(most);
    std::vector<Field> fields;
    int line = 0;
    while (problems_.size() < problems_until_giving_up)
      if (records_.next_numbers(numbers, line))
        add(numbers, line);
      else if (records_.next(fields, line))
        row(fields, line);
      else
        break;
    if (problems_.empty() && table_.rows() == 0)
      add("empty_file", line_of_header_, table_.file, "the file holds a header and no row",
          "record again, or name another file");
    if (!problems_.empty()) throw Error(Fault::input, problems_);
    return std::move(table_);
  }

 private:
  void add(std::string code, int line, std::string path, std::string what, std::string cure) {
    problems_.push_back({std::move(code), std::move(path), std::move(what), std::move(cure), table_.file, line});
  }

  void header() {
    std::vector<Field> fields;
    if (!records_.next(fields, line_of_header_)) {
      add("empty_file", 1, table_.file, "the file is empty", "record again, or name another file");
      throw Error(Fault::input, problems_);
    }
    double ignored = 0;
    if (std::all_of(fields.begin(), fields.end(),
                    [&](const Field& f) { return !f.quoted && parse_number(f.text, ignored); })) {
      add("no_header", line_of_header_, table_.file, "the first line holds numbers, not the names of the columns",
          "write a first line such as: t [s],u [V],y [um]");
      throw Error(Fault::input, problems_);
    }
    for (const auto& field : fields) column(unquoted(field));
    if (!problems_.empty()) throw Error(Fault::input, problems_);
  }

  void column(const std::string& heading) {
    CsvColumn column;
    const PlainHeading read = plain_heading(heading);
    column.name = read.name;
    if (column.name.empty()) {
      const bool other_separator = heading.find_first_of(";\t") != heading.npos;
      add("no_header", line_of_header_, table_.file, fmt::format("column {} has no name", table_.columns.size() + 1),
          other_separator ? "separate columns by commas"
                          : "write a name and a unit, such as y [um], or take the empty column out");
    } else if (!names_.insert(column.name).second) {
      add("duplicate_column", line_of_header_, column.name, fmt::format("two columns are called \"{}\"", column.name),
          "give one of them another name");
    } else if (column.name.find_first_of(";\t") != column.name.npos) {
      add("no_header", line_of_header_, table_.file, fmt::format("\"{}\" is no name of a column", column.name),
          "separate columns by commas (and write decimals with a point)");
    }
    try {
      if (read.has_unit) column.unit = parse_unit(read.unit, column.name);
    } catch (const Error& error) {
      for (const auto& p : error.problems) add(p.code, line_of_header_, column.name, p.what, p.cure);
    }
    table_.columns.push_back(std::move(column));
  }

  void add(const std::vector<double>& numbers, int line) {
    table_.lines.push_back(line);
    for (std::size_t i = 0; i < numbers.size(); ++i) table_.columns[i].values.push_back(numbers[i]);
  }

  void row(const std::vector<Field>& fields, int line) {
    const std::size_t expected = table_.columns.size();
    if (fields.size() != expected) {
      add("row_length", line, table_.file,
          fmt::format("this row has {} cells, the header has {}", fields.size(), expected),
          fields.size() > expected ? "write decimals with a point and one cell per column"
                                   : "complete the row, or take it out");
      return;
    }
    table_.lines.push_back(line);
    for (std::size_t i = 0; i < expected; ++i) {
      double value = 0;
      if (!parse_number(fields[i].text, value)) bad_number(fields[i], table_.columns[i].name, line);
      table_.columns[i].values.push_back(value);
    }
  }

  void bad_number(const Field& field, const std::string& column, int line) {
    std::string text = unquoted(field);
    if (text.size() > 40) text = text.substr(0, 40) + "...";
    const std::string found = text.empty() ? "an empty cell" : fmt::format("\"{}\"", text);
    add("bad_number", line, column, fmt::format("column \"{}\" holds {}, a finite number was expected", column, found),
        "take the row out, or cut the recording there: nothing is filled in silently");
  }

  std::string text_;
  Records records_;
  CsvTable table_;
  std::unordered_set<std::string> names_;  // of its columns
  int line_of_header_ = 1;
  std::vector<Problem> problems_;
};

std::string heading_text(const CsvColumn& column) {
  return csv_cell(column.unit.text.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit.text));
}

}  // namespace

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == text.npos && !text.starts_with('#')) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

const CsvColumn* CsvTable::find(const std::string& name) const {
  const auto name_at = [&](std::size_t place) { return std::string_view(columns[place].name); };
  std::shared_ptr<const Names> known = std::atomic_load(&names);  // threads may ask at once
  if (!known || known->columns != columns.size()) {
    auto now = std::make_shared<Names>();
    now->columns = columns.size();
    now->index.rebuild(columns.size(), name_at);
    std::atomic_store(&names, known = std::move(now));
  }
  if (const auto place = known->index.find(name, columns.size(), name_at); place >= 0)
    return &columns[static_cast<std::size_t>(place)];
  // Not there, or a column was renamed.
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const auto& column) { return column.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

bool has_plain_header(std::string_view text) {
  Records records(text);
  std::vector<Field> fields;
  int line = 0;
  if (!records.next(fields, line)) return false;
  bool has_time = false;
  std::unordered_set<std::string> names;
  for (const auto& field : fields) {
    const PlainHeading heading = plain_heading(unquoted(field));
    if (heading.name.empty() || heading.name.find_first_of(";\t") != heading.name.npos) return false;
    if (!names.insert(heading.name).second) return false;
    try {
      const Unit unit = heading.has_unit ? parse_unit(heading.unit) : Unit{};
      has_time = has_time || (heading.name == "t" && unit.dimension == parse_unit("s").dimension);
    } catch (const Error&) {
      return false;
    }
    if (!heading.has_unit && !heading_of(heading.name).unit.empty()) return false;  // "y (um)"
  }
  return has_time;
}

CsvTable read_csv(const std::string& file) { return Reader(file).read(); }

namespace {

std::string csv_head(const CsvTable& table, const std::vector<std::string>& comments) {
  std::string out;
  for (const auto& comment : comments) out += fmt::format("# {}\n", comment);
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const auto& column = table.columns[i];
    if (column.values.size() != table.rows())
      fail(
          "row_length", table.file,
          fmt::format("column \"{}\" has {} values, the first has {}", column.name, column.values.size(), table.rows()),
          "give every column one value per row");
    if (i > 0) out += ',';
    out += heading_text(column);
  }
  return out += '\n';
}

/// Writes rows from `row` on behind `out`, until it holds `enough` bytes; returns the first row that it has not
/// written.
std::size_t append_rows(const CsvTable& table, std::size_t row, std::size_t enough, std::string& out) {
  constexpr std::size_t longest = 32;  // a number is 24 characters at most, its comma or end of line one more
  const std::size_t longest_row = longest * table.columns.size();
  LookUp look_up;
  std::size_t used = out.size();
  for (; row < table.rows() && used < enough; ++row) {
    look_up();
    if (out.size() < used + longest_row) out.resize(used + std::max(longest_row, std::min(enough, used)));
    char* at = out.data() + used;
    for (const auto& column : table.columns) {
      at = fmt::format_to(at, FMT_COMPILE("{}"), column.values[row]);
      *at++ = ',';
    }
    at[-1] = '\n';
    used = static_cast<std::size_t>(at - out.data());
  }
  out.resize(used);
  return row;
}

constexpr std::size_t piece = 1 << 18;  // [byte] formatted and written while it is in the processor's cache

}  // namespace

std::string csv_text(const CsvTable& table, const std::vector<std::string>& comments) {
  std::string out = csv_head(table, comments);
  append_rows(table, 0, std::numeric_limits<std::size_t>::max(), out);
  return out;
}

void write_csv(const std::string& file, const CsvTable& table, const std::vector<std::string>& comments) {
  std::string text = csv_head(table, comments);
  bool head = true;
  std::size_t row = 0;
  write_file_in_pieces(file, [&]() -> std::string_view {
    if (!std::exchange(head, false)) text.clear();
    row = append_rows(table, row, piece, text);
    return text;
  });
}

}  // namespace hysteron
