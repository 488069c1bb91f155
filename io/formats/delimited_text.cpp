#include "io/formats/delimited_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"
#include "io/files/atomic_file.h"
#include "io/formats/decoded_text.h"
#include "io/formats/text_head.h"

namespace hysteron {
namespace {

constexpr std::size_t problems_at_most = 20;
constexpr std::int64_t half_a_day = 43'200LL * 1'000'000'000;

/// A column while it is read: of numbers, or of times of day.
struct CellColumn {
  std::vector<double> numbers{};
  std::vector<std::int64_t> nanoseconds{};  ///< of a column of times of day
  bool is_clock = false, has_date = false, has_clock = false, order_unclear = false;
  bool empty = true;
};

class TextReader {
 public:
  TextReader(const std::string& file, DecodedText content, const ReadingChoices& choices)
      : choices_(choices), text_(std::move(content.text)), lines_(lines_of(text_)) {
    table_.file = file;
    if (!content.assumed.empty()) table_.assumed.push_back("written in " + content.assumed);
    if (std::all_of(lines_.begin(), lines_.end(), says_nothing))
      throw Error(Fault::input,
                  {{"empty_file", file, "the file is empty", "record again, or name another file", file, 1}});
  }

  MeasuredTable read() {
    layout_ = layout_of(table_.file, lines_, choices_.decimal);
    TextHead head = head_of(table_.file, lines_, layout_, choices_.names);
    note_form();
    table_.assumed.insert(table_.assumed.end(), head.assumed.begin(), head.assumed.end());
    table_.clock = head.clock;
    columns_.resize(head.headings.size());
    rows();
    join_date_and_time(head.headings);
    for (std::size_t i = 0; i < columns_.size(); ++i) finish(head.headings[i], columns_[i]);
    return std::move(table_);
  }

 private:
  void note_form() {
    if (layout_.form.separator != ',')
      table_.assumed.push_back("separated by " + separator_text(layout_.form.separator));
    if (layout_.form.decimal == ',') table_.assumed.push_back("decimal comma");
  }

  void add(std::string code, std::size_t line, std::string path, std::string what, std::string cure) {
    problems_.push_back(
        {std::move(code), std::move(path), std::move(what), std::move(cure), table_.file, static_cast<int>(line) + 1});
  }

  void rows() {
    std::vector<std::string_view> cells;
    LookUp look_up;
    for (std::size_t i = layout_.begin; i < lines_.size() && problems_.size() < problems_at_most; ++i) {
      if ((i & 1023) == 0) look_up();
      if (says_nothing(lines_[i])) continue;
      split_cells(lines_[i], layout_.form.separator, cells);
      cells.erase(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(std::min(layout_.skipped, cells.size())));
      if (is_behind_the_table(i, cells)) break;
      row(i, cells);
    }
    if (!problems_.empty()) throw Error(Fault::input, problems_);
  }

  bool any_number(const std::vector<std::string_view>& cells) const {
    return std::any_of(cells.begin(), cells.end(), [&](std::string_view c) {
      return cell_number(c, layout_.form.decimal).has_value() || clock_time(c).has_value();
    });
  }

  bool is_row(std::string_view line) const {
    std::vector<std::string_view> cells;
    if (says_nothing(line)) return false;
    split_cells(line, layout_.form.separator, cells);
    return are_numbers(cells, layout_.form.decimal);
  }

  /// Words, or the beginning of a row, where nothing else follows.
  bool is_behind_the_table(std::size_t line, const std::vector<std::string_view>& cells) {
    const bool numbers = are_numbers(cells, layout_.form.decimal);
    if (numbers && cells.size() >= fewest_) return false;
    const bool more = std::any_of(lines_.begin() + static_cast<std::ptrdiff_t>(line) + 1, lines_.end(),
                                  [&](std::string_view later) { return is_row(later); });
    if (any_number(cells) && (more || (!numbers && cells.size() >= fewest_))) return false;  // a row that is wrong
    if (more)
      add("second_table", line, table_.file, "the table ends here, and other numbers follow",
          "keep one recording in each file: cut the file before this line");
    else
      table_.assumed.push_back(fmt::format("line {} and what follows is no part of the table", line + 1));
    return true;
  }

  void row(std::size_t line, const std::vector<std::string_view>& cells) {
    std::size_t n = cells.size();
    while (n > columns_.size() && cells[n - 1].empty()) --n;
    if (n > columns_.size() || n < fewest_) {
      return add("row_length", line, table_.file,
                 fmt::format("this row has {} cells, the header has {}", n, columns_.size()),
                 n > columns_.size() ? "write one cell per column; decimals with a comma need another separator"
                                     : "complete the row, or take it out");
    }
    if (table_.lines.empty()) fewest_ = n;
    table_.lines.push_back(static_cast<int>(line) + 1);
    for (std::size_t i = 0; i < columns_.size(); ++i) cell(line, i, i < n ? cells[i] : std::string_view());
  }

  void cell(std::size_t line, std::size_t index, std::string_view text) {
    CellColumn& column = columns_[index];
    if (const auto number = cell_number(text, layout_.form.decimal); number && !column.is_clock) {
      column.empty = false;
      column.numbers.push_back(is_overload(*number) ? no_value : *number);
      return;
    }
    if (says_no_value(text) || says_overload(text)) {
      if (column.is_clock) column.nanoseconds.push_back(column.nanoseconds.empty() ? 0 : column.nanoseconds.back());
      column.numbers.push_back(no_value);
      return;
    }
    if (const auto time = clock_time(text); time && (column.is_clock || column.empty)) {
      column.is_clock = true;
      column.has_date = time->has_date;
      column.has_clock = column.has_clock || time->has_clock;
      column.order_unclear = column.order_unclear || time->order_unclear;
      column.empty = false;
      column.nanoseconds.resize(column.numbers.size());
      column.nanoseconds.push_back(time->nanoseconds);
      column.numbers.push_back(0);
      return;
    }
    std::string shown(text.substr(0, 40));
    add("bad_number", line, fmt::format("column {}", index + 1),
        fmt::format("a cell holds \"{}\", a number was expected", shown),
        "take the row out, or cut the recording there: nothing is filled in silently");
    column.numbers.push_back(no_value);
  }

  /// A date in one column, the time of day in the next.
  void join_date_and_time(std::vector<Heading>& headings) {
    for (std::size_t i = 0; i + 1 < columns_.size(); ++i) {
      CellColumn &date = columns_[i], &time = columns_[i + 1];
      if (!date.is_clock || date.has_clock || !time.is_clock || time.has_date) continue;
      for (std::size_t k = 0; k < time.nanoseconds.size(); ++k) time.nanoseconds[k] += date.nanoseconds[k];
      time.has_date = true;
      time.order_unclear = date.order_unclear;
      columns_.erase(columns_.begin() + static_cast<std::ptrdiff_t>(i));
      headings.erase(headings.begin() + static_cast<std::ptrdiff_t>(i));
      table_.assumed.push_back("date and time of day from two columns");
    }
  }

  void finish(Heading& heading, CellColumn& column) {
    if (!column.is_clock) {
      table_.columns.push_back({std::move(heading.name), std::move(heading.unit), std::move(column.numbers)});
      return;
    }
    auto& ns = column.nanoseconds;
    if (!column.has_date)  // behind midnight a day is added
      for (std::size_t k = 1; k < ns.size(); ++k)
        while (ns[k] < ns[k - 1] - half_a_day) ns[k] += 2 * half_a_day;
    const auto [least, most] = std::minmax_element(ns.begin(), ns.end());
    if (column.order_unclear && *most - *least >= 2 * half_a_day)
      throw Error(Fault::input, {{"ambiguous_date", heading.name,
                                  "\"05/04/2026\" is a day of April or of May, and the recording is "
                                  "longer than a day",
                                  "write the dates as 2026-04-05, or give the distance of the rows with --interval",
                                  table_.file, table_.lines.front()}});
    const std::int64_t first = ns.empty() ? 0 : ns.front();
    for (std::size_t k = 0; k < ns.size(); ++k)
      if (!std::isnan(column.numbers[k])) column.numbers[k] = static_cast<double>(ns[k] - first) / 1e9;
    if (!table_.time) table_.time = table_.columns.size();
    table_.assumed.push_back(fmt::format("{}: times of day, counted from the first row",
                                         heading.name.empty() ? "the first column" : heading.name));
    table_.columns.push_back({std::move(heading.name), "s", std::move(column.numbers)});
  }

  const ReadingChoices& choices_;
  MeasuredTable table_;
  std::string text_;
  std::vector<std::string_view> lines_;
  TextLayout layout_;
  std::vector<CellColumn> columns_;
  std::size_t fewest_ = 1;  ///< cells of the first row: later ones may leave out no more
  std::vector<Problem> problems_;
};

}  // namespace

MeasuredTable read_delimited_text(const std::string& file, const ReadingChoices& choices) {
  return TextReader(file, decoded(read_file(file)), choices).read();
}

MeasuredTable read_delimited_text(const std::string& file, const std::string& text, const ReadingChoices& choices) {
  return TextReader(file, {text, ""}, choices).read();
}

}  // namespace hysteron
