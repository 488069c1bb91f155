#include "fit/inspect/inspected_rows.h"

#include <algorithm>

namespace hysteron {

std::vector<InspectedPart> parts_of(const DataSet& data) {
  std::vector<InspectedPart> parts;
  for (std::size_t r = 0; r < data.recordings.size(); ++r) {
    const Recording& recording = data.recordings[r];
    if (recording.role == Role::test) continue;
    if (data.single && !parts.empty())
      parts.front().last = recording.last;
    else
      parts.push_back({static_cast<int>(r), recording.first, recording.last, recording.name});
  }
  return parts;
}

std::span<const double> rows_of(const DataSet& data, const InspectedPart& part, const std::string& column) {
  const auto& columns = data.recordings[static_cast<std::size_t>(part.recording)].columns;
  const auto found = columns.find(column);
  if (found == columns.end()) return {};
  return std::span(found->second).subspan(part.first, part.last - part.first);
}

bool is_left_out(const DataSet& data, const InspectedPart& part, std::size_t row) {
  const auto& left_out = data.recordings[static_cast<std::size_t>(part.recording)].left_out;
  return !left_out.empty() && left_out[part.first + row];
}

std::vector<double> judged_of(const DataSet& data, const InspectedPart& part, const std::string& column) {
  const auto rows = rows_of(data, part, column);
  std::vector<double> judged;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!is_left_out(data, part, i)) judged.push_back(rows[i]);
  return judged;
}

std::span<const double> times_of(const DataModel& model, const InspectedPart& part) {
  return std::span(model.recording(part.recording).t).subspan(part.first, part.last - part.first);
}

double range_of(std::span<const double> v) {
  if (v.empty()) return 0;
  const auto [low, high] = std::minmax_element(v.begin(), v.end());
  return *high - *low;
}

std::vector<std::pair<std::string, std::span<const double>>> drives_of(const DataModel& model,
                                                                       const InspectedPart& part) {
  std::vector<std::pair<std::string, std::span<const double>>> drives;
  for (const auto& name : model.program().input_names)
    if (const auto rows = rows_of(model, part, name); range_of(rows) > 0) drives.emplace_back(name, rows);
  return drives;
}

}  // namespace hysteron
