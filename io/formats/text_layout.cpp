#include "io/formats/text_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/diagram/error.h"

namespace hysteron {
namespace {

constexpr std::size_t lines_looked_at = 2000;  // no instrument writes so many lines above its table

/// How well a form fits the lines: the longest run of rows with the same number of cells.
struct Fit {
  CellForm form;
  std::size_t rows = 0, cells = 0, numbers = 0;
  bool better_than(const Fit& other) const {
    if (rows != other.rows) return rows > other.rows;
    return form.separator != ' ' && numbers > other.numbers;  // a date and its time of day are one cell
  }
};

std::size_t count_numbers(const std::vector<std::string_view>& cells, char decimal) {
  return static_cast<std::size_t>(std::count_if(cells.begin(), cells.end(), [&](std::string_view c) {
    return cell_number(c, decimal).has_value() || clock_time(c).has_value();
  }));
}

Fit fit_of(const std::vector<std::string_view>& lines, CellForm form) {
  Fit best{form}, run{form};
  std::vector<std::string_view> cells;
  for (std::size_t i = 0; i < std::min(lines.size(), lines_looked_at); ++i) {
    if (says_nothing(lines[i])) continue;
    split_cells(lines[i], form.separator, cells);
    if (!are_numbers(cells, form.decimal)) {
      run = {form};
      continue;
    }
    if (cells.size() != run.cells) run = {form, 0, cells.size(), count_numbers(cells, form.decimal)};
    ++run.rows;
    if (run.rows > best.rows) best = run;
  }
  return best;
}

/// Whether all numbers with a comma look like "1,234": thousands, or a decimal comma with three digits.
bool comma_is_ambiguous(const std::vector<std::string_view>& lines, const TextLayout& layout) {
  bool any = false;
  std::vector<std::string_view> cells;
  for (std::size_t i = layout.begin; i < std::min(lines.size(), layout.begin + lines_looked_at); ++i) {
    split_cells(lines[i], layout.form.separator, cells);
    for (auto cell : cells) {
      const auto comma = cell.find(',');
      if (comma == cell.npos || clock_time(cell)) continue;
      if (cell.front() == '-' || cell.front() == '+') cell.remove_prefix(1);
      const auto whole = cell.substr(0, cell.find(',')), part = cell.substr(cell.find(',') + 1);
      if (part.size() != 3 || whole.empty() || whole.size() > 3 || whole.front() == '0' ||
          part.find_first_not_of("0123456789") != part.npos || whole.find_first_not_of("0123456789") != whole.npos)
        return false;
      any = true;
    }
  }
  return any;
}

[[noreturn]] void fail_without_table(const std::string& file) {
  throw Error(
      Fault::input,
      {{"no_table", file, "no line of this file is a row of numbers",
        "name a file that holds a table: a line of names such as t [s],u [V],y [um], and numbers below it", file, 1}});
}

/// First line whose cells are numbers, `cells` of them.
std::size_t begin_of(const std::vector<std::string_view>& lines, const Fit& fit) {
  std::vector<std::string_view> cells;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (says_nothing(lines[i])) continue;
    split_cells(lines[i], fit.form.separator, cells);
    if (cells.size() == fit.cells && are_numbers(cells, fit.form.decimal)) return i;
  }
  return 0;
}

std::size_t leading_empty(const std::vector<std::string_view>& cells) {
  return static_cast<std::size_t>(
      std::find_if(cells.begin(), cells.end(), [](std::string_view c) { return !c.empty(); }) - cells.begin());
}

/// Where the first cells of all rows are empty, settings of the instrument may stand there beside the first rows.
void look_beside(const std::vector<std::string_view>& lines, TextLayout& layout) {
  std::vector<std::string_view> cells;
  std::size_t skipped = layout.cells;
  for (std::size_t i = layout.begin; i < std::min(lines.size(), layout.begin + lines_looked_at); ++i) {
    if (says_nothing(lines[i])) continue;
    split_cells(lines[i], layout.form.separator, cells);
    if (cells.size() == layout.cells && are_numbers(cells, layout.form.decimal))
      skipped = std::min(skipped, leading_empty(cells));
  }
  if (skipped == 0 || skipped == layout.cells) return;
  layout.skipped = skipped;
  while (layout.begin > 0) {
    split_cells(lines[layout.begin - 1], layout.form.separator, cells);
    if (cells.size() <= skipped) return;
    cells.erase(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(skipped));
    if (!are_numbers(cells, layout.form.decimal)) return;
    --layout.begin;
  }
}

}  // namespace

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const auto end = std::min(text.find_first_of("\r\n", begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
    if (end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n') ++begin;
  }
  return lines;
}

bool says_nothing(std::string_view line) {
  line = without_blanks(line);
  return line.empty() || line.front() == '#' || line.front() == '%';
}

bool are_numbers(const std::vector<std::string_view>& cells, char decimal) {
  bool any = false;
  for (const auto cell : cells) {
    if (cell_number(cell, decimal) || clock_time(cell))
      any = true;
    else if (!says_no_value(cell) && !says_overload(cell))
      return false;
  }
  return any;
}

TextLayout layout_of(const std::string& file, const std::vector<std::string_view>& lines, const std::string& decimal) {
  const bool quotes = std::any_of(
      lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(lines.size(), lines_looked_at)),
      [](std::string_view line) { return line.find('"') != line.npos; });
  Fit best;
  for (const char separator : {'\t', ';', ',', '|', ' '})
    for (const char sign : {'.', ','}) {
      if (separator == ',' && sign == ',' && !quotes) continue;
      if (!decimal.empty() && (decimal == "comma") != (sign == ',') && separator != ',') continue;
      const Fit fit = fit_of(lines, {separator, sign});
      if (fit.better_than(best)) best = fit;
    }
  if (best.rows == 0) fail_without_table(file);
  TextLayout layout{best.form, begin_of(lines, best), best.cells, 0};
  look_beside(lines, layout);
  if (decimal.empty() && best.form.separator != ',' && comma_is_ambiguous(lines, layout))
    throw Error(
        Fault::input,
        {{"ambiguous_decimal", file, "every number with a comma looks like \"1,234\": a decimal comma, or thousands",
          "say which: --decimal comma, or --decimal point", file, static_cast<int>(layout.begin) + 1}});
  return layout;
}

std::string separator_text(char separator) {
  switch (separator) {
    case '\t':
      return "tabs";
    case ' ':
      return "blanks";
    default:
      return fmt::format("\"{}\"", separator);
  }
}

}  // namespace hysteron
