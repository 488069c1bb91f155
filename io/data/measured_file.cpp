#include "io/data/measured_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "engine/diagram/error.h"
#include "engine/diagram/name_list.h"
#include "engine/diagram/number_text.h"
#include "io/data/binary_table.h"
#include "io/data/table_file.h"
#include "io/files/atomic_file.h"
#include "io/files/shell_word.h"
#include "io/formats/cells.h"
#include "io/formats/file_format.h"
#include "io/formats/heading.h"
#include "io/formats/instrument_unit.h"
#include "io/json/value_text.h"

namespace hysteron {
namespace {

constexpr double sparse = 0.5;               // of the rows without a value: the column was sampled at another rate
constexpr double seconds_of_an_epoch = 1e8;  // times that large count from 1970, or 1904

std::string short_number(double value) { return fmt::format("{:.6g}", value); }

class Finisher {
 public:
  Finisher(MeasuredTable measured, const ReadingChoices& choices) : in_(std::move(measured)), choices_(choices) {
    out_.assumed = in_.assumed;
    out_.table.file = in_.file;
  }

  MeasuredFile finish() {
    drop_unwanted();
    name_columns();
    find_time();
    check_choices();
    units();
    complete_rows();
    count_from_begin();
    return std::move(out_);
  }

 private:
  [[noreturn]] void refuse(std::string code, std::string path, std::string what, std::string cure, int line = 1) const {
    throw Error(Fault::input, {{std::move(code), std::move(path), std::move(what), std::move(cure), in_.file, line}});
  }

  std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const auto& column : in_.columns) list.push_back(column.name);
    return list;
  }

  void erase(std::size_t index) {
    in_.columns.erase(in_.columns.begin() + static_cast<std::ptrdiff_t>(index));
    if (in_.time && *in_.time == index) in_.time.reset();
    if (in_.time && *in_.time > index) --*in_.time;
  }

  /// Headings above which instruments write settings or remarks instead of samples.
  static bool is_of_no_signal(const std::string& name) {
    return name == "comment" || name == "start" || name == "increment" || name.starts_with("t0") ||
           name.starts_with("tinc");
  }

  static bool is_empty(const MeasuredColumn& column) {
    return std::all_of(column.values.begin(), column.values.end(), [](double v) { return std::isnan(v); });
  }

  void drop_unwanted() {
    for (const auto& name : choices_.without) {
      const auto known = names();
      const auto found = std::find(known.begin(), known.end(), name);
      if (found == known.end())
        refuse("missing_column", name, fmt::format("--without names a column \"{}\" that is not there", name),
               did_you_mean(name, known));
      erase(static_cast<std::size_t>(found - known.begin()));
    }
    if (in_.rows() == 0)
      refuse("empty_file", in_.file, "the file holds a header and no row", "record again, or name another file");
    for (std::size_t i = in_.columns.size(); i-- > 0;) {
      if (!is_empty(in_.columns[i])) continue;
      const std::string& name = in_.columns[i].name;
      if (!name.empty() && !is_of_no_signal(lower_case_of(name)))
        out_.assumed.push_back(fmt::format("column {} is empty and left out", json_quoted(name)));
      erase(i);
    }
    if (in_.columns.empty())
      refuse("empty_file", in_.file, "every column is empty", "record again, or name another file");
  }

  /// Each column a name of its own.
  void name_columns() {
    std::vector<std::string> taken;
    std::size_t channel = 0;
    for (std::size_t i = 0; i < in_.columns.size(); ++i) {
      auto& column = in_.columns[i];
      std::string name = column.name;
      std::replace_if(
          name.begin(), name.end(), [](char c) { return c == '\n' || c == '\r' || c == '"'; }, ' ');
      const bool is_time = in_.time == i || is_time_name(name);
      if (!is_time) ++channel;
      if (name.empty()) name = column.unit.empty() || !is_second(column) ? fmt::format("column_{}", i + 1) : "time";
      if (number_of(name)) name = fmt::format("channel_{}", name);  // "1" on the screen of the instrument
      const std::string plain = name;
      for (int k = 2; std::find(taken.begin(), taken.end(), name) != taken.end(); ++k)
        name = fmt::format("{}_{}", plain, k);
      if (name != column.name && !column.name.empty())
        out_.assumed.push_back(fmt::format("column {} is called {}", json_quoted(column.name), name));
      column.name = name;
      taken.push_back(name);
    }
  }

  static bool is_second(const MeasuredColumn& column) {
    const auto known = instrument_unit(column.unit, column.name, true);
    return known.answer == UnitAnswer::known && !known.unit.empty() && is_time_unit(known.unit);
  }
  static bool is_time_unit(const std::string& unit) {
    try {
      return parse_unit(unit).dimension == parse_unit("s").dimension;
    } catch (const Error&) {
      return false;
    }
  }

  /// The columns that may be the times: by their names, else by their unit.
  std::vector<std::size_t> time_candidates() const {
    std::vector<std::size_t> by_name, by_unit;
    for (std::size_t i = 0; i < in_.columns.size(); ++i) {
      const auto& column = in_.columns[i];
      if (column.name == "t") return {i};
      if (is_time_name(column.name)) by_name.push_back(i);
      const auto unit = instrument_unit(column.unit, column.name);
      const bool second = unit.answer == UnitAnswer::known && !unit.unit.empty() && is_time_unit(unit.unit);
      if (second || (i == 0 && lower_case_of(column.unit) == "s")) by_unit.push_back(i);
    }
    return by_name.empty() ? by_unit : by_name;
  }

  void find_time() {
    if (choices_.interval) return take_interval({0, *choices_.interval}, "as --interval says");
    if (!choices_.time.empty()) {
      const auto known = names();
      const auto found = std::find(known.begin(), known.end(), choices_.time);
      if (found == known.end())
        refuse("missing_column", choices_.time,
               fmt::format("--time names a column \"{}\" that is not there", choices_.time),
               did_you_mean(choices_.time, known));
      return take_time(static_cast<std::size_t>(found - known.begin()));
    }
    if (in_.time) return take_time(*in_.time);
    auto candidates = time_candidates();
    if (candidates.size() > 1) drop_same_times(candidates);
    if (candidates.size() > 1) {
      std::vector<std::string> list;
      for (const auto i : candidates) list.push_back(in_.columns[i].name);
      refuse("ambiguous_time", in_.file, fmt::format("{} columns may be the time: {}", list.size(), name_list(list)),
             fmt::format("say which: --time {}", shell_word(list.front())));
    }
    if (!candidates.empty()) return take_time(candidates.front());
    if (in_.clock) return take_interval(*in_.clock, "from the settings in the file");
    refuse(
        "missing_column", "t", "no column is the time",
        fmt::format("call it t [s], say which column it is with --time NAME (columns here: {}), or how far apart the "
                    "rows are: --interval \"1 ms\"",
                    name_list(names())));
  }

  /// Exports of several channels repeat the times for each.
  void drop_same_times(std::vector<std::size_t>& candidates) {
    for (std::size_t k = candidates.size(); k-- > 1;) {
      if (in_.columns[candidates[k]].values != in_.columns[candidates[0]].values) continue;
      out_.assumed.push_back(
          fmt::format("column {} repeats the times and is left out", in_.columns[candidates[k]].name));
      erase(candidates[k]);
      candidates.erase(candidates.begin() + static_cast<std::ptrdiff_t>(k));
    }
  }

  /// "time_ms" without a unit says it in its name.
  static std::string unit_in_name(const std::string& name) {
    const auto sign = name.find_last_of("_ ");
    if (sign == name.npos || sign + 1 >= name.size()) return "";
    const auto unit = instrument_unit(name.substr(sign + 1), "", true);
    return unit.answer == UnitAnswer::known && is_time_unit(unit.unit) ? unit.unit : "";
  }

  void take_time(std::size_t index) {
    MeasuredColumn& time = in_.columns[index];
    const auto chosen = choices_.units.find(time.name);
    std::string written = chosen == choices_.units.end() ? time.unit : chosen->second;
    if (written.empty()) written = unit_in_name(time.name);
    const bool open = written.empty();
    if (open) written = "s";
    const auto unit = instrument_unit(written, time.name, true);
    if (unit.answer != UnitAnswer::known || !is_time_unit(unit.unit))
      refuse("wrong_unit", time.name, fmt::format("the time is in [{}], a unit of time was expected", written),
             fmt::format("say it: --unit {}=ms", time.name));
    if (open)
      out_.assumed.push_back(fmt::format("{} is the time; it has no unit and is taken as s", time.name));
    else if (time.name != "t")
      out_.assumed.push_back(fmt::format("{} is the time, in {}", time.name, unit.unit));
    time_name_ = time.name;
    out_.table.columns.push_back({"t", parse_unit(unit.unit), std::move(time.values)});
    erase(index);
    drop_other("t");
  }

  void take_interval(SampleClock clock, const char* why) {
    if (!(clock.interval > 0) || !std::isfinite(clock.interval))
      refuse("bad_value", "--interval", "the rows must be some time apart", "write a time above 0, such as \"1 ms\"");
    if (in_.clock && choices_.interval) clock.start = in_.clock->start;
    std::vector<double> t(in_.rows());
    for (std::size_t k = 0; k < t.size(); ++k)  // as the instrument would have written them
      t[k] = rounded_to_digits(clock.start + static_cast<double>(k) * clock.interval, 13);
    out_.table.columns.push_back({"t", parse_unit("s"), std::move(t)});
    out_.assumed.push_back(fmt::format("times from the sample interval {} s{}, {}", short_number(clock.interval),
                                       clock.start != 0 ? fmt::format(", from {} s on", short_number(clock.start)) : "",
                                       why));
    for (std::size_t i = in_.columns.size(); i-- > 0;)
      if (is_counter(in_.columns[i]) || is_time_name(in_.columns[i].name)) erase(i);
    in_.time.reset();
    drop_other("t");
  }

  /// Another column of that name would hide behind the time.
  void drop_other(const std::string& name) {
    for (auto& column : in_.columns)
      if (column.name == name) column.name += "_column";
  }

  static bool is_counter(const MeasuredColumn& column) {
    if (!is_counter_name(column.name) && !is_counter_name(column.unit)) return false;
    for (std::size_t k = 1; k < column.values.size(); ++k)
      if (column.values[k] != column.values[k - 1] + 1) return false;
    return true;
  }

  void check_choices() const {
    for (const auto& [name, unit] : choices_.units) {
      auto known = names();
      if (name == time_name_ || std::find(known.begin(), known.end(), name) != known.end()) continue;
      if (choices_.units_may_miss) continue;
      refuse("missing_column", name, fmt::format("--unit names a column \"{}\" that is not there", name),
             did_you_mean(name, known));
    }
  }

  void units() {
    std::vector<Problem> problems;
    std::vector<std::string> bare;
    for (auto& column : in_.columns) {
      const auto chosen = choices_.units.find(column.name);
      const std::string written = chosen == choices_.units.end() ? column.unit : chosen->second;
      const auto unit = is_counter_name(written) && chosen == choices_.units.end()
                            ? InstrumentUnit{UnitAnswer::known, "", "", ""}
                            : instrument_unit(written, column.name);
      const auto add = [&](const char* code, std::string what, std::string cure) {
        problems.push_back({code, column.name, std::move(what), std::move(cure), in_.file, 1});
      };
      const std::string option = fmt::format("--unit {}=", shell_word(column.name));
      if (unit.answer == UnitAnswer::unknown)
        add("bad_unit", fmt::format("\"{}\" is not a unit", written),
            fmt::format("say which it is: {0}V, or {0}1 for a plain number (in a data set: \"unit\" of the column)",
                        option));
      if (unit.answer == UnitAnswer::refused)
        add("bad_unit", unit.note, unit.cure + fmt::format(", or leave it out: --without {}", shell_word(column.name)));
      if (unit.answer == UnitAnswer::ambiguous)
        add("ambiguous_unit", unit.note, fmt::format("say which ({}): {}gravity", unit.cure, option));
      if (unit.answer != UnitAnswer::known) continue;
      if (written.empty()) bare.push_back(column.name);
      if (!unit.note.empty()) out_.assumed.push_back(fmt::format("{}: {}", column.name, unit.note));
      out_.table.columns.push_back({column.name, parse_unit(unit.unit, column.name), std::move(column.values)});
    }
    if (!problems.empty()) throw Error(Fault::input, problems);
    if (!bare.empty())
      out_.assumed.push_back(fmt::format("{} {} no unit and {} taken as plain numbers", name_list(bare),
                                         bare.size() == 1 ? "has" : "have", bare.size() == 1 ? "is" : "are"));
  }

  int line_of(std::size_t row) const { return in_.lines.empty() ? static_cast<int>(row) + 1 : in_.lines[row]; }

  void complete_rows() {
    auto& columns = out_.table.columns;
    const std::size_t rows = columns.front().values.size();
    for (const auto& column : columns) {
      const auto missing =
          std::count_if(column.values.begin(), column.values.end(), [](double v) { return std::isnan(v); });
      if (static_cast<double>(missing) > sparse * static_cast<double>(rows))
        refuse("sparse_column", column.name,
               fmt::format("column {} has a value in {} of {} rows: it was sampled at another rate", column.name,
                           static_cast<long>(rows) - missing, rows),
               fmt::format("leave it out (--without {}), or export it to a file of its own", shell_word(column.name)));
    }
    std::vector<std::size_t> kept;
    std::size_t first_missing = rows;
    std::string where;
    for (std::size_t k = 0; k < rows; ++k) {
      const auto missing =
          std::find_if(columns.begin(), columns.end(), [&](const CsvColumn& c) { return std::isnan(c.values[k]); });
      if (missing == columns.end())
        kept.push_back(k);
      else if (first_missing == rows)
        first_missing = k, where = missing->name;
    }
    for (const auto k : kept) out_.table.lines.push_back(line_of(k));
    if (kept.size() == rows) return;
    out_.assumed.push_back(fmt::format("{} left out, in which a column has no value (the first: {} in line {})",
                                       rows_text(rows - kept.size()), where, line_of(first_missing)));
    for (auto& column : columns) {
      for (std::size_t k = 0; k < kept.size(); ++k) column.values[k] = column.values[kept[k]];
      column.values.resize(kept.size());
    }
  }

  void count_from_begin() {
    CsvColumn& time = out_.table.columns.front();
    if (time.values.empty() || !(std::abs(time.unit.to_si(time.values.front())) > seconds_of_an_epoch)) return;
    const double begin = time.values.front();
    for (double& t : time.values) t -= begin;
    out_.assumed.push_back(fmt::format("times count from the first row, which is {:.15g} {}", begin, time.unit.text));
  }

  MeasuredTable in_;
  const ReadingChoices& choices_;
  MeasuredFile out_;
  std::string time_name_;
};

bool nothing_chosen(const ReadingChoices& c) {
  return c.time.empty() && !c.interval && c.without.empty() && c.names.empty() && c.decimal.empty() &&
         c.sheet.empty() && c.group.empty();
}

/// A table of ours, with the units that the user gives instead.
MeasuredFile as_it_stands(const std::string& file, const ReadingChoices& choices) {
  MeasuredFile read{read_table(file), true};
  for (auto& column : read.table.columns) {
    const auto chosen = choices.units.find(column.name);
    if (chosen == choices.units.end()) continue;
    const auto unit = instrument_unit(chosen->second, column.name);
    column.unit = parse_unit(unit.answer == UnitAnswer::known ? unit.unit : chosen->second, column.name);
    read.as_it_stands = false;
  }
  return read;
}

/// Cells that are empty or hold a mark. "nan" and "inf" in a table of ours come from a program that failed.
bool only_missing_values(const Error& error) {
  return std::all_of(error.problems.begin(), error.problems.end(), [](const Problem& p) {
    const std::string what = lower_case_of(p.what);
    return p.code == "bad_number" && what.find("nan\"") == what.npos && what.find("inf\"") == what.npos;
  });
}

}  // namespace

namespace {

/// Whether the file begins as tables of ours do, by its first lines; by all of it where these say no.
bool begins_plainly(const std::string& file) {
  std::string begin(1 << 20, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(stream.gcount()));
  begin.resize(begin.rfind('\n') + 1);  // whole lines, or none
  return has_plain_header(begin) || has_plain_header(read_file(file));
}

}  // namespace

MeasuredFile finished(MeasuredTable measured, const ReadingChoices& choices) {
  return Finisher(std::move(measured), choices).finish();
}

MeasuredFile read_measured_file(const std::string& file, const ReadingChoices& choices) {
  if (is_binary_table(file)) return as_it_stands(file, choices);
  if (nothing_chosen(choices) && is_text_file(file) && begins_plainly(file)) {
    try {
      return as_it_stands(file, choices);
    } catch (const Error& error) {
      if (!only_missing_values(error)) throw;
      try {
        return finished(read_measured_table(file, choices), choices);
      } catch (const Error&) {
        throw error;
      }
    }
  }
  return finished(read_measured_table(file, choices), choices);
}

}  // namespace hysteron
