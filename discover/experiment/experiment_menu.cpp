// Decides what the menu of experiments knows of a device. See experiment_menu.h.
#include "discover/experiment/experiment_menu.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/numerics/median.h"

namespace hysteron {
namespace {

void note_range(Device& d, const std::string& name, const std::vector<double>& v) {
  const auto [a, b] = std::minmax_element(v.begin(), v.end());
  const auto [at, is_new] = d.ranges.try_emplace(name, *a, *b);
  at->second = {std::min(at->second.first, *a), std::max(at->second.second, *b)};
  d.levels[name] = v.front();
}

void note_speed(Device& d, const std::string& name, const Series& s) {
  double& fastest = d.fastest[name];
  for (std::size_t k = 1; k < s.v.size(); ++k)
    fastest = std::max(fastest, std::abs(s.v[k] - s.v[k - 1]) / (s.t[k] - s.t[k - 1]));
}

/// Columns that a program may read: its inputs, and what it does not measure.
std::map<std::string, Series> moved_in(const Device& d, const Program& program, const DataSet& data,
                                       const Recording& r) {
  std::map<std::string, Series> list;
  for (const auto& name : d.inputs) list[name] = *input_series(data, r, name);
  for (const auto& [name, column] : r.columns)
    if (!list.contains(name) &&
        std::find(program.output_names.begin(), program.output_names.end(), name) == program.output_names.end())
      list[name] = {r.t, column, Between::linear};
  return list;
}

/// A room cannot be driven like an amplifier: a temperature is left out where something else moves.
std::vector<Drive> drives_of(const Device& d, const Program& program) {
  const Dimension kelvin = parse_unit("K").dimension;
  std::vector<Drive> drives, temperatures;
  for (std::size_t i = 0; i < d.inputs.size(); ++i) {
    const auto range = d.ranges.find(d.inputs[i]);
    if (range == d.ranges.end() || !(range->second.second > range->second.first)) continue;
    const Unit& unit = program.input_units[i];
    (unit.dimension == kelvin ? temperatures : drives)
        .push_back({d.inputs[i], unit, range->second.first, range->second.second});
  }
  return drives.empty() ? temperatures : drives;
}

}  // namespace

Device device_of(const Program& program, const DataSet& data) {
  Device d;
  d.shortest_step = std::numeric_limits<double>::infinity();
  d.longest_recording = 0;
  d.inputs = program.input_names;
  for (const auto& r : data.recordings) {
    if (r.role == Role::test || r.last < 2) continue;
    d.shortest_step = std::min(d.shortest_step, median_step({r.t.begin(), r.t.begin() + static_cast<long>(r.last)}));
    auto moved = moved_in(d, program, data, r);
    for (const auto& [name, series] : moved) {
      note_range(d, name, series.v);
      note_speed(d, name, series);
    }
    const double duration = r.t[r.last - 1] - r.t.front();
    if (duration <= d.longest_recording) continue;
    d.longest_recording = duration;
    d.recorded_times = r.t;
    d.recorded = std::move(moved);
  }
  d.drives = drives_of(d, program);
  return d;
}

double fastest_of(const Device& device, const std::string& signal) {
  const auto found = device.fastest.find(signal);
  return found == device.fastest.end() || !(found->second > 0) ? std::numeric_limits<double>::infinity()
                                                               : found->second;
}

std::string which_moves(const Device& device, const Drive& drive) {
  return device.inputs.size() > 1 ? fmt::format("move {}, hold the other inputs: ", drive.name) : "";
}

}  // namespace hysteron
