#include "discover/placement/visible.h"

#include <fmt/format.h>

#include <algorithm>

#include "discover/placement/excitation.h"
#include "discover/placement/places.h"

namespace hysteron {

namespace {

/// "mass_spring_damper, mass_with_drag": the types by which an effect may enter.
std::string offered_by(const Effect& effect, const Registry& registry) {
  std::vector<std::string> types;
  for (const auto& type : registry.types())
    if (varied_by(effect, registry.find(type)->declaration) != nullptr) types.push_back(type);
  return fmt::format("{}", fmt::join(types, ", "));
}

/// How near an effect that cannot be seen at a place comes to it: 2 = other recordings would show it, 1 = the diagram
/// has something else that does the same, 0 = it is no place for it.
int nearness(const Effect& effect, Excitation at) {
  at.from_data = false;
  if (effect.unseen(at).empty()) return 2;
  at.memory_blocks.clear();
  return effect.unseen(at).empty() ? 1 : 0;
}

}  // namespace

std::string why_no_place(const Effect& e, const Registry& registry) {
  if (!e.variation.empty())
    return fmt::format("it changes the law of a block, and the diagram has none of: {}", offered_by(e, registry));
  if (e.way == Way::vary)
    return fmt::format("no block of the diagram has the parameter \"{}\" (a memory)", e.parameter);
  if (e.side == Side::temperature) return "no column of the recordings is a temperature beside the outputs";
  if (e.side == Side::force) return "no force is recorded";
  if (e.side == Side::use)
    return "no recording states the cycles or the age of the device at its start (cycles_before, start)";
  if (e.side == Side::other_axis) return "no other axis is recorded";
  if (e.least_outputs > 1)
    return fmt::format(
        "no drive has {} measured outputs behind it: with one, drive gain and sensor gain cannot be separated",
        e.least_outputs);
  return "the diagram has no place where it could enter";
}

std::vector<Visible> visible_effects(const Diagram& diagram, const DataSet& data, const Registry& registry,
                                     const Effects& effects, const std::vector<std::string>& free_paths) {
  std::vector<Visible> list;
  std::vector<Place> places;
  std::vector<std::size_t> of;  // per place: its effect in `list`
  for (const auto& e : effects.list()) {
    list.push_back({e.id, e.title, {}, {}, {}, false});
    for (auto& p : places_of(e, diagram, registry, &data)) {
      of.push_back(list.size() - 1);
      places.push_back(std::move(p));
    }
    if (!of.empty() && of.back() == list.size() - 1) continue;
    list.back().reason = why_no_place(e, registry);
    list.back().needs_block = e.way == Way::vary || !e.variation.empty();
  }
  if (places.empty()) return list;
  std::vector<int> nearest(list.size(), -1);  // of the place that gave the reason
  std::vector<bool> well(list.size(), false);
  const auto seen = circumstances_at(diagram, registry, data, places, free_paths);
  for (std::size_t i = 0; i < places.size(); ++i) {
    Visible& v = list[of[i]];
    const std::string why = effects.list()[of[i]].unseen(seen[i]);
    const bool known = std::find(v.places.begin(), v.places.end(), places[i].where()) != v.places.end();
    if (why.empty() && !known) v.places.push_back(places[i].where());
    if (why.empty()) {
      const Effect& e = effects.list()[of[i]];
      v.unsure = e.unsure ? e.unsure(seen[i]) : "";
      well[of[i]] = well[of[i]] || v.unsure.empty();
      continue;
    }
    const int near = nearness(effects.list()[of[i]], seen[i]);
    if (near > nearest[of[i]]) {
      nearest[of[i]] = near;
      v.reason = why;
    }
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].can()) list[i].reason.clear();
    if (well[i]) list[i].unsure.clear();
  }
  return list;
}

}  // namespace hysteron
