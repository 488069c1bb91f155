// Decides how the bounds of a search are told. See bounds.h.
#include "discover/hypotheses/bounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

namespace hysteron {
namespace {

/// Recordings of some wire.
Excitation usual() {
  Excitation at;
  at.from_data = true;
  at.unit = parse_unit("V");
  at.lowest = -5;
  at.highest = 10;
  at.travel_highest = 1e-5;
  at.largest_jump = 1;
  at.longest_hold = 10;
  at.quickest = 10;
  at.swings.sizes = 3;
  at.resolution = 1e-3;
  at.side_lowest = at.side_at_start = 2;
  at.side_highest = 10;
  return at;
}

/// One thing about recordings, made larger.
struct Change {
  const char* what;
  std::function<void(Excitation&)> make;
};
const std::vector<Change>& changes() {
  static const std::vector<Change> all{
      {"the range of the signal",
       [](Excitation& at) {
         at.lowest *= 3;
         at.highest *= 3;
         at.travel_highest *= 3;
       }},
      {"the time between rows",
       [](Excitation& at) {
         at.shortest_step *= 3;
         at.longest_step *= 3;
         at.step_at_longest_hold *= 3;
       }},
      {"the length of the recordings", [](Excitation& at) { at.longest_recording *= 3; }},
      {"the longest hold", [](Excitation& at) { at.longest_hold *= 3; }},
      {"the pace of the signal", [](Excitation& at) { at.quickest *= 3; }},
      {"the levels of the column", [](Excitation& at) { at.resolution *= 3; }},
      {"what it reads besides", [](Excitation& at) {
         at.side_lowest /= 2;
         at.side_at_start /= 2;
         at.side_highest *= 1e4;          // of a use, decades
         at.side_unit = parse_unit("h");  // or hours
       }}};
  return all;
}

struct Bounds {
  double lower = 0, upper = 0;
};

/// The widest that any element has in any law.
std::optional<Bounds> bounds_of(const Effect& effect, const std::string& name, const Excitation& at) {
  std::optional<Bounds> widest;
  for (const auto& law : effect.laws(at))
    for (const auto& p : law.free) {
      if (p.path.substr(0, p.path.find('[')) != name.substr(0, name.find('['))) continue;
      if (!widest) widest = Bounds{p.lower, p.upper};
      widest->lower = std::min(widest->lower, p.lower);
      widest->upper = std::max(widest->upper, p.upper);
    }
  return widest;
}

}  // namespace

std::string bounds_text(const Effect& effect, const std::string& name) {
  const auto bounds = bounds_of(effect, name, usual());
  if (!bounds) return "";
  const auto end_text = [&](double Bounds::*end) -> std::string {
    std::vector<std::string> set_by;
    for (const auto& change : changes()) {
      Excitation at = usual();
      change.make(at);
      if (const auto changed = bounds_of(effect, name, at); changed && (*changed).*end != (*bounds).*end)
        set_by.emplace_back(change.what);
    }
    if (!set_by.empty()) return fmt::format("(set by {})", fmt::join(set_by, ", "));
    return std::isfinite((*bounds).*end) ? fmt::format("{:.4g}", (*bounds).*end) : "";
  };
  const std::string lower = end_text(&Bounds::lower), upper = end_text(&Bounds::upper);
  if (lower == upper) return lower;
  if (lower.empty()) return upper + " or less";
  return upper.empty() ? lower + " or more" : lower + " .. " + upper;
}

}  // namespace hysteron
