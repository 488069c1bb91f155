#include "fit/compare/trace_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "engine/diagram/error.h"
#include "engine/diagram/name_list.h"

namespace hysteron {
namespace {

std::string unit_text_of(const Unit& unit) { return unit.text.empty() ? "1" : unit.text; }

std::vector<std::string> names_of(const CsvTable& table) {
  std::vector<std::string> names;
  for (const auto& column : table.columns) names.push_back(column.name);
  return names;
}

const CsvColumn& column_of(const CsvTable& table, const std::string& name, const std::string& cure) {
  if (const CsvColumn* column = table.find(name)) return *column;
  const std::string known = did_you_mean(name, names_of(table));
  fail("missing_column", table.file, fmt::format("there is no column \"{}\"", name),
       cure.empty() ? known : fmt::format("{}; {}", cure, known));
}

const CsvColumn& axis_of(const CsvTable& table, const std::string& over) {
  if (!over.empty()) return column_of(table, over, "");
  const CsvColumn& t = column_of(table, "t", "name the time \"t [s]\", or the axis of a loop with --over");
  if (!(t.unit.dimension == parse_unit("s").dimension))
    fail("wrong_unit", table.file, fmt::format("the time t is in {}", unit_text_of(t.unit)), "write the header t [s]");
  return t;
}

/// Rows in the order in which the curve passes them: by time where there is one, else as they stand in the file.
std::vector<std::size_t> order_of(const CsvTable& table, const CsvColumn& axis, TraceCourse course) {
  std::vector<std::size_t> order(table.rows());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const CsvColumn* by = course == TraceCourse::rising ? &axis : table.find("t");
  if (by != nullptr)
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return by->values[a] < by->values[b]; });
  return order;
}

TraceLine line_of(const CsvColumn& axis, const CsvColumn& column, const std::vector<std::size_t>& order) {
  TraceLine line;
  for (const std::size_t row : order) {
    line.x.push_back(axis.unit.to_si(axis.values[row]));
    line.y.push_back(column.unit.to_si(column.values[row]));
  }
  return line;
}

void check_units(const CsvTable& a, const CsvColumn& first, const CsvTable& b, const CsvColumn& second) {
  if (first.unit.dimension == second.unit.dimension) return;
  const CsvColumn& bare = first.unit.text.empty() ? first : second;
  const CsvColumn& other = &bare == &first ? second : first;
  fail("wrong_unit", (&bare == &first ? a : b).file,
       fmt::format("{} is in {}, and {} of the other file in {}", bare.name, unit_text_of(bare.unit), other.name,
                   unit_text_of(other.unit)),
       fmt::format("write the unit into the header: {} [{}]", bare.name, unit_text_of(other.unit)));
}

std::vector<std::pair<std::string, std::string>> pairs_of(const CsvTable& first, const CsvTable& second,
                                                          const TraceWishes& wishes, const std::string& axis) {
  for (const auto& [a, b] : wishes.pairs) {
    column_of(first, a, "");
    column_of(second, b, "");
  }
  if (!wishes.pairs.empty()) return wishes.pairs;
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const auto& column : first.columns)
    if (column.name != axis && column.name != "t" && second.find(column.name) != nullptr)
      pairs.emplace_back(column.name, column.name);
  if (pairs.empty())
    fail("nothing_to_compare", first.file,
         fmt::format("no column besides {} has the same name in both files: {} and {}", axis,
                     name_list(names_of(first)), name_list(names_of(second))),
         "name the pair, first file first: --pair y=stage");
  return pairs;
}

std::optional<WrittenTolerance> tolerance_for(const TracePair& pair, const TraceWishes& wishes) {
  std::optional<WrittenTolerance> chosen;
  for (const auto& written : wishes.tolerances) {
    const bool named = written.signal == pair.first || written.signal == pair.second;
    if (named && !written.fits(pair.unit))
      fail("wrong_unit", "--tolerance",
           fmt::format("\"{}\": {} is in {}", written.written, pair.first, unit_text_of(pair.unit)),
           fmt::format("write the tolerance in {} or in %", unit_text_of(pair.unit)));
    if (named && chosen && !chosen->signal.empty())
      fail("bad_command_line", "--tolerance",
           fmt::format("{} has two tolerances: \"{}\" and \"{}\"", pair.first, chosen->written, written.written),
           "give one, with both parts: \"y: 2 nm + 0.1 %\"");
    const bool yields = chosen && !chosen->signal.empty() && !named;  // one for all yields to one for this signal
    if (named || (written.signal.empty() && written.fits(pair.unit) && !yields)) chosen = written;
  }
  return chosen;
}

void check_tolerances_used(const TraceComparison& comparison, const TraceWishes& wishes) {
  std::vector<std::string> names;
  for (const auto& pair : comparison.pairs) names.push_back(pair.first);
  for (const auto& written : wishes.tolerances) {
    const bool used = std::any_of(comparison.pairs.begin(), comparison.pairs.end(), [&](const TracePair& pair) {
      return written.signal.empty() ? written.fits(pair.unit)
                                    : written.signal == pair.first || written.signal == pair.second;
    });
    if (used) continue;
    if (written.signal.empty())
      fail("wrong_unit", "--tolerance",
           fmt::format("\"{}\" has the unit of no signal that both files hold", written.written),
           fmt::format("write it in {} or in %", unit_text_of(comparison.pairs.front().unit)));
    fail("unknown_signal", "--tolerance", fmt::format("no signal \"{}\" is compared", written.signal),
         did_you_mean(written.signal, names));
  }
}

void remark_on_order(const CsvTable& table, const std::vector<std::size_t>& order, TraceComparison& comparison) {
  if (!std::is_sorted(order.begin(), order.end()))
    comparison.remarks.push_back(
        fmt::format("{}: rows are not in the order of their times, and were put into it.", table.file));
}

void remark_on_lone_columns(const CsvTable& table, bool is_first, TraceComparison& comparison) {
  std::vector<std::string> lone;
  for (const auto& column : table.columns) {
    const bool compared = std::any_of(comparison.pairs.begin(), comparison.pairs.end(), [&](const TracePair& pair) {
      return (is_first ? pair.first : pair.second) == column.name;
    });
    if (!compared && column.name != comparison.axis && column.name != "t") lone.push_back(column.name);
  }
  if (!lone.empty())
    comparison.remarks.push_back(
        fmt::format("{}: not compared, the other file has none: {}.", table.file, name_list(lone)));
}

}  // namespace

bool TraceComparison::within() const {
  return std::none_of(pairs.begin(), pairs.end(),
                      [](const TracePair& pair) { return pair.written && pair.distance.outside > 0; });
}

TraceComparison compare_trace_files(const CsvTable& first, const CsvTable& second, const TraceWishes& wishes) {
  const CsvColumn &axis_a = axis_of(first, wishes.over), &axis_b = axis_of(second, wishes.over);
  check_units(first, axis_a, second, axis_b);
  TraceComparison comparison;
  comparison.axis = axis_a.name;
  comparison.axis_unit = axis_a.unit;
  comparison.course = wishes.over.empty() || wishes.over == "t" ? TraceCourse::rising : TraceCourse::to_and_fro;
  const auto order_a = order_of(first, axis_a, comparison.course),
             order_b = order_of(second, axis_b, comparison.course);
  remark_on_order(first, order_a, comparison);
  remark_on_order(second, order_b, comparison);
  for (const auto& [a, b] : pairs_of(first, second, wishes, axis_a.name)) {
    const CsvColumn &of_a = column_of(first, a, ""), &of_b = column_of(second, b, "");
    check_units(first, of_a, second, of_b);
    TracePair pair;
    pair.first = a;
    pair.second = b;
    pair.unit = of_a.unit;
    pair.first_line = line_of(axis_a, of_a, order_a);
    pair.second_line = line_of(axis_b, of_b, order_b);
    pair.written = tolerance_for(pair, wishes);
    const TraceTolerance tolerance =
        pair.written ? pair.written->in_si(comparison.axis_unit, comparison.axis) : TraceTolerance{};
    pair.distance = distance_of(pair.first_line, pair.second_line, comparison.course, tolerance);
    if (pair.distance.x.empty())
      fail("no_overlap", second.file, fmt::format("the two files have no part of {} in common", comparison.axis),
           "compare files of the same range; times count from the same zero in both");
    comparison.pairs.push_back(std::move(pair));
  }
  check_tolerances_used(comparison, wishes);
  if (wishes.pairs.empty()) {
    remark_on_lone_columns(first, true, comparison);
    remark_on_lone_columns(second, false, comparison);
  }
  return comparison;
}

}  // namespace hysteron
