// Decides which places are for which effect: blocks that it may vary, wires, and what it reads beside them. See
// places.h.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "discover/hypotheses/effect.h"
#include "discover/placement/places.h"
#include "discover/placement/wire_places.h"
#include "discover/wiring/wiring.h"
#include "engine/diagram/error.h"

namespace hysteron {
namespace {

/// Blocks of any level whose type has parameter `name`; a place of the whole list carries the path of the block.
void collect_vary(const Diagram& diagram, const Registry& registry, const std::string& name, const std::string& prefix,
                  std::vector<Place>& list) {
  const Wiring w(diagram, registry);
  for (const auto& [block, node] : diagram.blocks) {
    const Node* body = w.body(block);
    if (body == nullptr) continue;
    if (body->nested) {
      collect_vary(*body->nested, registry, name, prefix + block + "/", list);
      continue;
    }
    const KernelPointer k = kernel_of(registry, *body);
    if (k == nullptr || k->declaration.parameter_index(name) < 0 || k->advance == nullptr) continue;
    if (prefix.empty() && !w.reaches_output(w.outputs_of(block).front())) continue;
    Place p;
    p.kind = "core";
    p.at = prefix + block;
    p.wire = node.in.empty() ? "" : prefix + w.signal(node.in.front().from);
    list.push_back(std::move(p));
  }
}

/// The effect ids that already stand on a wire, and on the wire that leads to an input port.
std::vector<std::string> standing_at(const Wiring& w, const Registry& registry, const Place& place) {
  if (const auto slash = place.wire.find('/'); slash != std::string::npos) {
    Place inside = place;
    inside.wire = place.wire.substr(slash + 1);
    if (!place.reading.empty()) inside.reading = place.reading.substr(slash + 1);
    return standing_at(Wiring(*w.body(place.wire.substr(0, slash))->nested, registry), registry, inside);
  }
  std::vector<std::string> ids;
  const auto collect = [&](const std::string& wire) {
    for (const auto& name : w.chain(wire)) ids.push_back(w.diagram().blocks.find(name)->effect);
  };
  const std::string* output = output_of_reading(w.diagram(), place.reading);
  if (!place.reading.empty())  // between the wire and who reads it
    for (std::string s = output == nullptr ? place.wire : w.signal(*output);
         ids.size() < 64 && w.is_inserted(w.source(s));) {
      const Node& inserted = *w.diagram().blocks.find(w.source(s));
      ids.push_back(inserted.effect);
      s = w.signal(inserted.in.front().from);
    }
  const std::string start = start_of_chain(w, w.signal(place.wire));
  collect(start);
  const Node* maker = w.diagram().blocks.find(w.source(start));
  if (place.kind == "damping" && maker != nullptr) {  // what varies the block that makes the speed acts there, too
    ids.push_back(maker->effect);
    for (const auto& [name, candidate] : maker->from) ids.push_back(candidate.effect);
  }
  return ids;
}

/// True if a block that is its own variation is no longer neutral: a tank with the root of the level in it.
bool has_already(const VariationDeclaration& v, const Node& body) {
  if (v.type != body.type) return false;
  return std::any_of(v.null_value.begin(), v.null_value.end(), [&](const auto& null_value) {
    const Value* given = body.parameters.find(null_value.parameter);
    if (given == nullptr) return false;
    if (const auto* text = std::get_if<std::string>(&given->content)) return *text != null_value.value;
    const auto* number = std::get_if<Number>(&given->content);
    return number != nullptr && number->value != 0;
  });
}

/// Blocks, nested ones included, that offer the variation by which the effect may enter.
void collect_variations(const Diagram& diagram, const Registry& registry, const Effect& effect,
                        const std::string& prefix, std::vector<Place>& list) {
  const Wiring w(diagram, registry);
  for (const auto& [block, node] : diagram.blocks) {
    const Node* body = w.body(block);
    if (body == nullptr) continue;
    if (body->nested) {
      collect_variations(*body->nested, registry, effect, prefix + block + "/", list);
      continue;
    }
    if (has_effect(node, effect.id)) continue;
    const KernelPointer k = kernel_of(registry, *body);
    if (k == nullptr || node.in.empty()) continue;
    const VariationDeclaration* v = varied_by(effect, k->declaration);
    if (v == nullptr || has_already(*v, *body)) continue;
    Place p;
    p.kind = "force";
    p.at = prefix + block;
    p.wire = prefix + w.signal(node.in.front().from);
    p.by = v->type;
    p.is_other = v->name != effect.variation;
    list.push_back(std::move(p));
  }
}

/// Of the blocks that offer the other variation only, those whose output is of its kind.
void keep_where_it_may_be(const Effect& effect, const Diagram& diagram, const Registry& registry,
                          std::vector<Place>& list) {
  if (std::none_of(list.begin(), list.end(), [](const Place& p) { return p.is_other; })) return;
  const auto program = compile(diagram, registry);
  std::erase_if(list, [&](const Place& p) {
    if (!p.is_other) return false;
    const auto block = std::find_if(program->blocks.begin(), program->blocks.end(),
                                    [&](const BlockInstance& b) { return b.path == p.at; });
    return block == program->blocks.end() ||
           !effect.or_where(program->signals[static_cast<std::size_t>(block->y_begin)].unit);
  });
}

bool is_temperature(const Unit& unit) { return unit.dimension == parse_unit("K").dimension; }

/// True if `to` is made from `from`.
bool leads_to(const Wiring& w, const std::string& from, const std::string& to) {
  std::set<std::string> seen{to};
  std::vector<std::string> next{to};
  while (!next.empty()) {
    const std::string now = std::move(next.back());
    next.pop_back();
    if (now == from) return true;
    const std::string block = w.source(now);
    const Node* node = block.empty() ? nullptr : w.diagram().blocks.find(block);
    if (node == nullptr) continue;  // an input, or a column that the diagram does not read
    for (const Wire& wire : node->in)
      if (seen.insert(w.signal(wire.from)).second) next.push_back(w.signal(wire.from));
  }
  return false;
}

/// A signal that may stand beside a wire: its name and, where the diagram does not read it yet, its unit.
struct SideSignal {
  std::string name;
  Unit unit;
};

std::vector<SideSignal> side_signals(const Effect& effect, const Wiring& w, const DataSet* data) {
  const auto fits = [&](const std::string& name, const Unit& unit) {
    const bool use = name == column_of_cycles || name == column_of_start;
    if (effect.side == Side::use || use) return use && effect.side == Side::use;
    if (effect.side == Side::force) return unit.dimension == parse_unit("N").dimension;
    if (effect.side == Side::temperature) return is_temperature(unit);
    // A bare number is a count or a mark; one with a unit is not, as the "%" of a heater.
    const bool bare = unit.dimension.none() && (unit.text.empty() || unit.text == "1");
    return !is_temperature(unit) && !bare;
  };
  std::vector<SideSignal> list;
  for (const auto& [name, input] : w.diagram().inputs)
    if (fits(name, parse_unit(input.unit))) list.push_back({name, {}});
  if (const auto measured = measured_wires(w);
      effect.side == Side::other_axis && measured.size() > 1)  // its motion, not only its drive
    for (const auto& s : measured) list.push_back({start_of_chain(w, before_offset(w, s)), {}});
  if (data == nullptr) return list;
  const auto is_output = [&](const std::string& name) {
    const auto& outputs = w.diagram().outputs;
    return std::any_of(outputs.begin(), outputs.end(), [&](const auto& o) { return is_of_output(name, o.first); });
  };
  for (const auto& [name, note] : data->notes) {
    if (w.is_input(name) || is_output(name)) continue;
    const auto has = [&](const Recording& r) { return r.columns.contains(name); };
    if (data->recordings.empty() || !std::all_of(data->recordings.begin(), data->recordings.end(), has)) continue;
    const Unit& unit = data->recordings.front().units.at(name);
    // The drive of another axis looks like a drive: in the unit of an input.
    const auto like_input = [&] {
      for (const auto& [other, input] : w.diagram().inputs)
        if (parse_unit(input.unit).dimension == unit.dimension) return true;
      return false;
    };
    if (fits(name, unit) && (effect.side != Side::other_axis || like_input())) list.push_back({name, unit});
  }
  return list;
}

/// Each place with each side signal that does not move its wire already.
std::vector<Place> beside(const std::vector<Place>& places, const Effect& effect, const Wiring& w,
                          const DataSet* data) {
  std::vector<Place> list;
  const auto signals = side_signals(effect, w, data);
  for (const auto& place : places) {
    if (place.at.find('/') != std::string::npos) continue;  // no wire leads into a nested diagram from here
    for (const auto& side : signals) {
      const std::string wire = w.signal(place.wire);
      if (effect.side == Side::other_axis && (leads_to(w, side.name, wire) || leads_to(w, wire, side.name))) continue;
      Place p = place;
      p.side = side.name;
      p.side_unit = side.unit;
      list.push_back(std::move(p));
    }
  }
  return list;
}

/// The block that makes this wire is among the places: what acts beside a damping behind it acts there.
bool acts_on(const std::vector<Place>& places, const std::string& wire) {
  const std::string block = wire.substr(0, wire.find('.'));
  return std::any_of(places.begin(), places.end(), [&](const Place& p) { return !p.by.empty() && p.at == block; });
}

/// Nothing but a constant lies between a wire and an output.
bool is_measured(const Wiring& w, const Registry& registry, const std::string& wire) {
  const auto measured = measured_wires(w);
  return std::any_of(measured.begin(), measured.end(), [&](const std::string& s) {
    return on_wire(w, registry, "measured", start_of_chain(w, before_offset(w, s))).wire == wire;
  });
}

/// Outputs behind a wire that any recording holds; all of them where there are none.
int measured_behind(const Wiring& w, const std::string& wire, const DataSet* data) {
  const auto outputs = w.outputs_on_the_way(w.signal(wire));
  return static_cast<int>(std::count_if(outputs.begin(), outputs.end(), [&](const std::string& output) {
    return data == nullptr || std::any_of(data->recordings.begin(), data->recordings.end(), [&](const Recording& r) {
             return std::any_of(r.columns.begin(), r.columns.end(),
                                [&](const auto& column) { return is_of_output(column.first, output); });
           });
  }));
}

}  // namespace

std::vector<Place> places_of(const Effect& effect, const Diagram& diagram, const Registry& registry,
                             const DataSet* data) {
  std::vector<Place> list;
  if (effect.way == Way::vary && effect.variation.empty()) {
    collect_vary(diagram, registry, effect.parameter, "", list);
    return list;
  }
  const Wiring w(diagram, registry);
  if (!effect.variation.empty()) collect_variations(diagram, registry, effect, "", list);
  keep_where_it_may_be(effect, diagram, registry, list);
  const bool varied = !list.empty();
  for (auto& place : find_places(diagram, registry)) {
    if (std::find(effect.places.begin(), effect.places.end(), place.kind) == effect.places.end()) continue;
    if (place.kind == "core" && effect.behind_core && !place.behind_core) continue;
    if (effect.else_a_block && place.kind == (varied ? "core" : "measured")) continue;
    if (place.kind == "damping" && acts_on(list, place.wire)) continue;
    const auto there = standing_at(w, registry, place);
    if (std::find(there.begin(), there.end(), effect.id) != there.end()) continue;
    // "core" before and behind may be one wire: one place.
    const bool known = std::any_of(list.begin(), list.end(), [&](const Place& p) { return p.at == place.at; });
    if (!known) list.push_back(std::move(place));
  }
  if (effect.least_outputs > 1)
    std::erase_if(list, [&](const Place& p) { return measured_behind(w, p.wire, data) < effect.least_outputs; });
  if (effect.before_sensor && diagram.places.find("core") == nullptr)
    std::erase_if(list, [&](const Place& p) { return is_measured(w, registry, p.wire); });
  if (effect.side != Side::none) return beside(list, effect, w, data);
  // The zero of a sensor stands behind everything, and so does what its cable picks up: they enter at the output
  // itself.
  if ((effect.block_type == "calibration" || effect.block_type == "mains_interference" ||
       effect.block_type == "rounding") &&
      diagram.places.find("measured") == nullptr) {
    list.clear();
    for (const auto& reading : readings(w))
      for (auto& p : measured_places(w, registry, reading, true)) {
        const auto there = standing_at(w, registry, p);
        if (std::find(there.begin(), there.end(), effect.id) == there.end()) list.push_back(std::move(p));
      }
  }
  return list;
}

Place place_for(const Effect& effect, const Diagram& diagram, const Registry& registry, const std::string& at,
                const DataSet* data) {
  std::vector<Place> places;
  if (at.empty()) {
    places = places_of(effect, diagram, registry, data);
  } else if (effect.way == Way::vary && effect.variation.empty()) {
    places.emplace_back().at = at;
  } else if (diagram.blocks.find(at) != nullptr && !effect.variation.empty()) {
    collect_variations(diagram, registry, effect, "", places);
    keep_where_it_may_be(effect, diagram, registry, places);
    std::erase_if(places, [&](const Place& p) { return p.at != at; });
    if (places.empty()) places = {place_at(diagram, registry, at)};
  } else {
    places = {place_at(diagram, registry, at)};
    if (effect.side != Side::none) places = beside(places, effect, Wiring(diagram, registry), data);
  }
  if (!places.empty()) return places.front();
  if (effect.side != Side::none)
    fail("no_side_signal", effect.id,
         effect.side == Side::use ? "it needs the cycles or the age of the device, and no recording states them"
         : effect.side == Side::force
             ? "it reads a force, and neither an input of the diagram nor a column of the recordings is one"
         : effect.side == Side::temperature
             ? "it reads a temperature, and neither an input of the diagram nor a column of the recordings is one"
             : "it reads the drive of another axis, and there is none",
         effect.side == Side::use     ? "write \"cycles_before\" or \"start\" at each recording of the data set"
         : effect.side == Side::force ? "give the diagram an input in N, or name recordings with such a column (--data)"
         : effect.side == Side::temperature
             ? "give the diagram an input in K or degC, or name recordings with such a column (--data)"
             : "give the diagram a second input, or name recordings with such a column (--data)");
  fail("unknown_place", effect.id,
       fmt::format("{} has no place in this diagram where it does not stand already", effect.id),
       effect.way == Way::vary
           ? fmt::format("it needs a block with memory that has a parameter \"{}\"", effect.parameter)
           : "name one with --at SIGNAL or --at BLOCK.in");
}

}  // namespace hysteron
