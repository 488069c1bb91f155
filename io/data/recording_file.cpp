#include "io/data/recording_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/diagram/error.h"
#include "engine/diagram/name_list.h"
#include "engine/program/breakpoints.h"
#include "io/data/measured_file.h"
#include "io/data/table_file.h"
#include "io/json/value_text.h"

namespace hysteron {
namespace {

constexpr double largest_measured = 1e100;  // squares and sums of squares stay numbers
constexpr double rounded_share = 0.1;       // of the rows that repeat a time: no slip, the clock was rounded
constexpr double shortest_spacing = 1e-18;  // [s] no instrument samples so fast; rates between rows stay numbers

[[noreturn]] void fail_in(const std::string& file, int line, std::string code, std::string path, std::string what,
                          std::string cure) {
  throw Error(Fault::input, {{std::move(code), std::move(path), std::move(what), std::move(cure), file, line}});
}

const CsvColumn& time_column(const CsvTable& table) {
  const auto* time = table.find("t");
  if (time == nullptr) {
    std::vector<std::string> known;
    for (const auto& c : table.columns) known.push_back(c.name);
    fail_in(table.file, 1, "missing_column", "t", "there is no column \"t\" (time)",
            fmt::format("call the column of the times t [s] (columns here: {}).{}", name_list(known),
                        bracket_hint("t", known)));
  }
  if (time->unit.dimension != parse_unit("s").dimension)
    fail_in(table.file, 1, "wrong_unit", "t",
            fmt::format("the time is in [{}], a unit of time was expected", time->unit.text),
            "write t [s], t [ms] ... into the header");
  return *time;
}

/// Times that never go back, and stand still where they should not have been rounded.
void refuse_rounded_times(const CsvTable& table, const CsvColumn& time) {
  const auto& t = time.values;
  std::size_t repeated = 0;
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (t[i] < t[i - 1]) return;
    repeated += t[i] == t[i - 1] ? 1U : 0U;
  }
  if (repeated < 3 || static_cast<double>(repeated) < rounded_share * static_cast<double>(t.size())) return;
  const auto first = std::adjacent_find(t.begin(), t.end());
  const auto last = std::find_if(first, t.end(), [&](double v) { return v != *first; });
  const auto line = [&](auto at) { return table.lines.at(static_cast<std::size_t>(at - t.begin())); };
  fail_in(table.file, line(first), "decreasing_time", "t",
          fmt::format("the times were written with too few digits: {} [{}] stands in lines {} to {}",
                      exact_number_text(*first), time.unit.text, line(first), line(last - 1)),
          "export them with more digits, or give the sample interval of the instrument: hysteron new --from FILE "
          "--interval \"...\" -o FOLDER");
}

void check_order(const CsvTable& table, const CsvColumn& time) {
  refuse_rounded_times(table, time);
  std::vector<Problem> problems;
  for (std::size_t i = 1; i < time.values.size() && problems.size() < 20; ++i)
    if (!(time.values[i] > time.values[i - 1]))
      problems.push_back(
          {"decreasing_time", "t",
           fmt::format("time does not increase: {} follows {} [{}]", exact_number_text(time.values[i]),
                       exact_number_text(time.values[i - 1]), time.unit.text),
           "sort the rows and take out those that stand twice; two recordings in one file belong into two files",
           table.file, table.lines[i]});
  if (!problems.empty()) throw Error(Fault::input, problems);
  for (std::size_t i = 1; i < time.values.size(); ++i) {
    const double t = time.unit.to_si(time.values[i]), spacing = t - time.unit.to_si(time.values[i - 1]);
    if (spacing > std::max(shortest_spacing, same_instant(t))) continue;
    fail_in(table.file, table.lines[i], "rows_too_near", "t",
            fmt::format("two rows are {:.3g} s apart at t = {:.6g} s, where times must be {:.2g} s apart to be told "
                        "from each other",
                        spacing, t, std::max(shortest_spacing, same_instant(t))),
            "check the column and its unit; let the times count from the begin of the recording");
  }
}

}  // namespace

std::string bracket_hint(const std::string& name, const std::vector<std::string>& columns) {
  for (const auto& column : columns) {
    const auto open = column.find('(');
    if (open == column.npos || !column.ends_with(')')) continue;
    const auto end = column.find_last_not_of(' ', open == 0 ? 0 : open - 1);
    if (open > 0 && column.substr(0, end + 1) == name)
      return fmt::format(" Units stand in square brackets: {} [{}]", name,
                         column.substr(open + 1, column.size() - open - 2));
  }
  return "";
}

void check_sizes(const CsvTable& table) {
  std::vector<Problem> problems;
  const auto is_measured = [](double value) { return std::abs(value) <= largest_measured; };
  for (const auto& column : table.columns) {
    const auto& v = column.values;
    const auto first = std::find_if_not(v.begin(), v.end(), is_measured);
    if (first == v.end()) continue;
    const auto more = std::count_if(first + 1, v.end(), [&](double value) { return !is_measured(value); });
    problems.push_back({"bad_number", column.name,
                        fmt::format("column \"{}\" holds {}{}: no instrument measures beyond {}", column.name,
                                    exact_number_text(*first), more > 0 ? fmt::format(" (and {} more such)", more) : "",
                                    exact_number_text(largest_measured)),
                        "take the row out, or cut the recording there: nothing is filled in silently", table.file,
                        table.lines[static_cast<std::size_t>(first - v.begin())]});
  }
  if (!problems.empty()) throw Error(Fault::input, problems);
}

void check_times(const CsvTable& table) { check_order(table, time_column(table)); }

namespace {

RecordingFile recording_of(CsvTable table, std::size_t fewest_rows) {
  check_sizes(table);
  const CsvColumn& time = time_column(table);
  check_order(table, time);
  if (table.rows() < fewest_rows)
    fail_in(table.file, table.lines.empty() ? 0 : table.lines.back(), "too_few_rows", table.file,
            fmt::format("there {} {}, at least {} are needed", table.rows() == 1 ? "is" : "are",
                        rows_text(table.rows()), fewest_rows),
            "record longer, or name another file");
  RecordingFile recording;
  recording.file = table.file;
  for (auto& column : table.columns) {
    std::vector<double> si = std::move(column.values);
    for (double& v : si) v = column.unit.to_si(v);
    if (&column == &time) {
      recording.t = std::move(si);
      continue;
    }
    recording.names.push_back(column.name);
    recording.units[column.name] = column.unit;
    recording.columns[column.name] = std::move(si);
  }
  return recording;
}

}  // namespace

RecordingFile read_recording_file(const std::string& file, std::size_t fewest_rows) {
  return recording_of(read_table(file), fewest_rows);
}

RecordingFile read_measured_recording(const std::string& file, std::size_t fewest_rows, const ReadingChoices& choices) {
  MeasuredFile read = read_measured_file(file, choices);
  RecordingFile recording = recording_of(std::move(read.table), fewest_rows);
  recording.file = file;
  recording.assumed = read.assumed;
  return recording;
}

}  // namespace hysteron
