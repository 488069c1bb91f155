// Decides the experiments for effects that read a signal beside the drive: a temperature, the cycles behind the device,
// another axis. See experiment_menu.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "discover/experiment/experiment_menu.h"
#include "discover/hypotheses/effect_terms.h"
#include "discover/hypotheses/room_temperature.h"

namespace hysteron {
namespace {

using effects::rounded;
using effects::time_text;

/// What the device had behind it when a recording began (a data set's cycles_before, start).
bool is_use(const SideRead& side) { return side.name == "cycles_before" || side.name == "start"; }

double start_of(const Device& d, const std::string& signal) {
  const auto found = d.levels.find(signal);
  return found == d.levels.end() ? 0 : found->second;
}

std::pair<double, double> range_of(const Device& d, const std::string& signal) {
  const auto found = d.ranges.find(signal);
  return found == d.ranges.end() ? std::pair<double, double>{} : found->second;
}

Protocol repeat_after_cycles(const Device& d, const std::string& use) {
  const double most = range_of(d, use).second;
  const bool cycles = use == "cycles_before";
  const double later = cycles ? 10 * most + 1e5 : 10 * most + 30 * 86400.0;
  Protocol p;
  p.word = "repeat_after_cycles";
  p.text = cycles ? fmt::format("the longest recording again after {:.2g} cycles", later)
                  : fmt::format("the longest recording again after {:.2g} days of use", later / 86400);
  p.t = d.recorded_times;
  p.moves = d.recorded;
  p.moves[use] = {{0.0}, {later}, Between::hold};
  p.controls_sides = true;
  return p;
}

/// Three plateaus, from today's temperature up, or back to a usual room where today's is none; on each a sine over
/// the whole range, then a hold.
Protocol temperature_staircase(const Device& d, const Drive& drive, const std::string& temperature) {
  const double from = start_of(d, temperature);
  const auto [coldest, warmest] = range_of(d, temperature);
  const double to_room = effects::usual_room(from) - from;
  const double up = std::max(10.0, 2 * (warmest - coldest));
  const double rise = std::abs(to_room) >= up / 3 ? to_room : up;
  const double whole = drive.highest - drive.lowest;
  // Two sines in half of it are nowhere faster than the recordings were.
  const double plateau =
      rounded(std::max(d.longest_recording / 2, 1.01 * 4 * std::numbers::pi * whole / fastest_of(d, drive.name)));
  Protocol p;
  p.word = "temperature_staircase";
  p.controls_sides = true;
  Series moved, warm;
  const int rows = 200;
  for (int k = 0; k < 3 * rows; ++k) {
    const int step = k / rows;
    const double part = static_cast<double>(k % rows) / rows;
    const double wave = part < 0.5 ? (1 - std::cos(8 * std::numbers::pi * part)) / 2 : 0;
    p.t.push_back((step + part) * plateau);
    moved.v.push_back(drive.lowest + wave * whole);
    warm.v.push_back(from + rise * step / 2);
  }
  moved.t = warm.t = p.t;
  p.moves = {{drive.name, std::move(moved)}, {temperature, std::move(warm)}};
  p.text = which_moves(d, drive) +
           fmt::format(
               "temperature {0:.3g} K, {1:.3g} K {3} today's on plateaus of {2} or more; on each, and before, "
               "two sines over the whole range and a hold",
               std::abs(rise / 2), std::abs(rise), time_text(plateau), rise > 0 ? "above" : "below");
  return p;
}

Protocol temperature_constant(const Device& d, const std::string& temperature) {
  Protocol p;
  p.word = "temperature_constant";
  p.text = fmt::format("the longest recording ({}) again, the temperature held, or at another time of the day",
                       time_text(d.longest_recording));
  p.t = d.recorded_times;
  p.moves = d.recorded;
  p.moves.erase(temperature);
  p.controls_sides = true;
  return p;
}

/// Each drive stands still while the others move.
Protocol axes_independent(const Device& d) {
  const int rows = 200;
  double needed = 0;  // nowhere faster than recorded
  for (const auto& drive : d.drives)
    needed = std::max(needed, 2.02 * (drive.highest - drive.lowest) / fastest_of(d, drive.name));
  const double period = rounded(std::max({d.longest_recording / 10, rows * d.shortest_step, needed}));
  Protocol p;
  p.word = "axes_independent";
  std::vector<std::string> names;
  for (std::size_t axis = 0; axis < d.drives.size(); ++axis) {
    names.push_back(d.drives[axis].name);
    for (int k = 0; k < rows; ++k) p.t.push_back((static_cast<double>(axis) + static_cast<double>(k) / rows) * period);
  }
  for (std::size_t axis = 0; axis < d.drives.size(); ++axis) {
    const Drive& drive = d.drives[axis];
    Series s;
    s.t = p.t;
    for (std::size_t k = 0; k < p.t.size(); ++k) {
      const double phase = static_cast<double>(k % rows) / rows;
      const double wave = k / rows != axis ? 0 : phase < 0.5 ? 2 * phase : 2 - 2 * phase;
      s.v.push_back(drive.lowest + wave * (drive.highest - drive.lowest));
    }
    p.moves[drive.name] = std::move(s);
  }
  p.text = fmt::format("a triangle of {} over the whole range of {} with the others still, one after the other",
                       time_text(period), fmt::join(names, ", "));
  return p;
}

}  // namespace

bool needs_control(const SideRead& side) { return side.kind == Side::temperature || is_use(side); }

std::vector<Protocol> side_protocols(const Device& device, const Drive& drive, const std::vector<SideRead>& sides) {
  std::vector<Protocol> list;
  const bool recorded = !device.recorded_times.empty();
  for (const auto& side : sides) {
    if (side.kind == Side::temperature) {
      list.push_back(temperature_staircase(device, drive, side.name));
      if (recorded) list.push_back(temperature_constant(device, side.name));
    }
    if (side.kind == Side::other_axis && device.drives.size() > 1) list.push_back(axes_independent(device));
    if (is_use(side) && recorded) list.push_back(repeat_after_cycles(device, side.name));
  }
  return list;
}

}  // namespace hysteron
