#include "io/data/left_out_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "io/json/value_text.h"

namespace hysteron {
namespace {

constexpr std::size_t rows_of_a_pile = 3;  // in a row at one extreme value: a converter at its end, no summit
constexpr double slack = 1e-9;             // of the range: what a conversion of units may take

void leave_out(Recording& recording, std::size_t row) {
  recording.left_out.resize(recording.t.size());
  recording.left_out[row] = true;
}

/// Whether so many rows one behind the other hold this value.
bool piles_up(const std::vector<double>& values, double level) {
  std::size_t run = 0;
  for (const double v : values) {
    run = v == level ? run + 1 : 0;
    if (run >= rows_of_a_pile) return true;
  }
  return false;
}

/// The extreme values of a column where rows pile up at them; infinite where they do not.
std::pair<double, double> found_limits(const std::vector<double>& values) {
  std::pair<double, double> limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (*low == *high) return limits;  // it never moves, which is no clipping
  if (piles_up(values, *low)) limits.first = *low;
  if (piles_up(values, *high)) limits.second = *high;
  return limits;
}

}  // namespace

std::size_t Recording::count_judged() const {
  if (left_out.empty()) return last - first;
  return static_cast<std::size_t>(std::count(left_out.begin() + static_cast<std::ptrdiff_t>(first),
                                             left_out.begin() + static_cast<std::ptrdiff_t>(last), false));
}

std::vector<double> Recording::judged(const std::vector<double>& column) const {
  const auto begin = column.begin() + static_cast<std::ptrdiff_t>(first);
  if (left_out.empty()) return {begin, column.begin() + static_cast<std::ptrdiff_t>(last)};
  std::vector<double> rows;
  rows.reserve(last - first);
  for (std::size_t i = first; i < last; ++i)
    if (!left_out[i]) rows.push_back(column[i]);
  return rows;
}

void leave_out_spans(Recording& recording, const std::vector<ExcludedSpan>& spans) {
  for (const auto& span : spans)
    for (std::size_t i = 0; i < recording.t.size(); ++i) {
      const double t = recording.t[i] - recording.t.front();
      if (t >= span.from && t <= span.to) leave_out(recording, i);
    }
}

std::vector<std::string> leave_out_clipped(Recording& recording, const std::map<std::string, ColumnNote>& notes) {
  std::vector<std::string> told;
  for (const auto& [name, note] : notes) {
    const auto column = recording.columns.find(name);
    if (column == recording.columns.end() || column->second.empty() || !(note.limits || note.find_limits)) continue;
    const auto& values = column->second;
    const auto [low, high] = note.limits ? *note.limits : found_limits(values);
    const double near = note.limits ? slack * (high - low) : 0;
    std::size_t rows = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] > low + near && values[i] < high - near) continue;
      leave_out(recording, i);
      ++rows;
    }
    const Unit& unit = recording.units.at(name);
    const auto text = [&](double si) { return fmt::format("{:.6g} {}", unit.from_si(si), unit.text); };
    if (rows > 0)
      told.push_back(fmt::format("{}: {} not judged, in which {} is at the end of its range ({}{}{}).", recording.name,
                                 rows_text(rows), name, low > -1e300 ? text(low) : "",
                                 low > -1e300 && high < 1e300 ? ", " : "", high < 1e300 ? text(high) : ""));
  }
  return told;
}

}  // namespace hysteron
