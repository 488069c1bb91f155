#include "discover/placement/wire_places.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "discover/effects/all.h"
#include "discover/hypotheses/effect.h"
#include "engine/block/instance.h"

namespace hysteron {
namespace {

int rank(const std::string& kind) {
  if (kind == "command") return 0;
  if (kind == "measured") return 2;
  return 1;  // core, force, motion
}

/// Nothing drives the block that makes this signal.
bool is_drive(const Wiring& w, const std::string& wire) {
  const Node* node = w.source(wire).empty() ? nullptr : w.diagram().blocks.find(w.source(wire));
  return node == nullptr || node->in.empty();
}

/// The rank of the place at which a block on this wire entered, the earliest that it may be: as its effect declares, or
/// core where it remembers; -1 = nobody knows.
int rank_of(const Wiring& w, const Registry& registry, const std::string& wire, const std::string& block) {
  static const Effects known = all_effects();
  const Node* outer = w.diagram().blocks.find(block);
  const Effect* effect = outer == nullptr ? nullptr : known.find(outer->effect);
  int earliest = -1;
  for (const auto& kind : effect == nullptr ? std::vector<std::string>{} : effect->places)
    if (kind != "command" || is_drive(w, wire)) earliest = earliest < 0 ? rank(kind) : std::min(earliest, rank(kind));
  if (earliest >= 0) return earliest;
  const Node* node = w.body(block);
  const KernelPointer k = node != nullptr && !node->nested ? kernel_of(registry, *node) : nullptr;
  if (k != nullptr && !k->declaration.place.empty()) return rank(k->declaration.place);
  return w.has_memory(block) ? rank("core") : -1;
}

/// What moves a reading alone: a zero, what a cable picks up, a converter.
bool is_offset(const Wiring& w, const std::string& block) {
  const Node* node = w.body(block);
  return node != nullptr && (node->type == "calibration" || node->type == "mains_interference" ||
                             node->type == "sensor_drift" || node->type == "rounding");
}

}  // namespace

Place on_wire(const Wiring& w, const Registry& registry, const std::string& kind, const std::string& wire,
              bool behind_offset) {
  Place p;
  p.kind = kind;
  p.at = p.wire = wire;
  for (const auto& effect : w.chain(wire)) {
    if (rank_of(w, registry, wire, effect) > rank(kind) || (!behind_offset && is_offset(w, effect))) {
      const auto ports = w.ports(effect);  // one that reads a second signal names its ports
      p.at = effect + "." + (ports.size() > 1 ? ports.front() : "in");
      p.on = wire;
      return p;
    }
    p.wire = effect;  // add_effect puts it behind the chain: that is the signal that the effect sees
  }
  return p;
}

std::string before_offset(const Wiring& w, const std::string& signal) {
  const std::string block = w.source(signal);
  if (block.empty()) return signal;
  const Node* node = w.body(block);
  if (node == nullptr || (node->type != "sum" && !is_offset(w, block))) return signal;
  std::string moving;
  for (const auto& wire : w.diagram().blocks.find(block)->in) {
    const std::string from = w.signal(wire.from);
    if (node->type == "sum" && w.is_constant(from)) continue;
    if (!moving.empty()) return signal;
    moving = from;
  }
  if (moving.empty() || w.followers(moving).size() != 1) return signal;
  return before_offset(w, moving);
}

std::string start_of_chain(const Wiring& w, const std::string& signal) {
  std::string start = signal, before = signal;
  for (int depth = 0; depth < 64 && w.is_inserted(w.source(before)); ++depth) {
    before = w.signal(w.diagram().blocks.find(w.source(before))->in.front().from);
    const auto chain = w.chain(before);
    if (std::find(chain.begin(), chain.end(), signal) != chain.end()) start = before;
  }
  return start;
}

std::vector<Reading> readings(const Wiring& w) {
  std::vector<Reading> list;
  for (const auto& [name, from] : w.diagram().outputs) {
    const std::string s = w.signal(from);
    if (s.empty()) continue;
    const std::string begin = start_of_chain(w, s);
    const Node* node = w.outputs_of(begin).empty() ? nullptr : w.body(begin);
    if (node != nullptr && node->type == "mux") {
      const auto& in = w.diagram().blocks.find(begin)->in;
      for (std::size_t i = 0; i < in.size(); ++i)
        list.push_back({w.signal(in[i].from), {begin, static_cast<int>(i), ""}});
    } else {
      list.push_back({s, {"", 0, name}});
    }
  }
  return list;
}

std::vector<std::string> measured_wires(const Wiring& w) {
  std::vector<std::string> list;
  for (auto& reading : readings(w)) list.push_back(std::move(reading.wire));
  return list;
}

namespace {

constexpr std::string_view outputs_prefix = "outputs.";

/// The signal without the effects that stand between it and who reads it.
std::string without_effects(const Wiring& w, std::string signal) {
  for (int depth = 0; depth < 64 && w.is_inserted(w.source(signal)); ++depth)
    signal = w.signal(w.diagram().blocks.find(w.source(signal))->in.front().from);
  return signal;
}

/// What samples a wire is a computer that reads a sensor; what does not says that it is a controller.
bool is_controller(const Wiring& w, const Registry& registry, const std::string& block) {
  const Node* node = w.body(block);
  if (node == nullptr || node->nested) return false;
  const KernelPointer k = kernel_of(registry, *node);
  return k != nullptr && (k->is_sampled() || k->declaration.is_controller);
}

/// Does a controller of the diagram act on this wire?
bool is_controlled(const Wiring& w, const Registry& registry, const std::string& wire) {
  std::set<std::string> seen;
  std::vector<std::string> open{wire};
  while (!open.empty()) {
    const std::string now = std::move(open.back());
    open.pop_back();
    for (const auto& reader : w.followers(now)) {
      if (reader.block.empty() || !seen.insert(reader.block).second) continue;
      if (is_controller(w, registry, reader.block)) return true;
      for (auto& next : w.outputs_of(reader.block)) open.push_back(std::move(next));
    }
  }
  return false;
}

/// Before what moves a reading alone and stands before it already.
void go_before_offsets(const Wiring& w, Place& p) {
  const std::string where = p.at;
  for (int depth = 0; depth < 64; ++depth) {
    const std::string block = w.source(p.wire);
    if (!w.is_inserted(block) || !is_offset(w, block)) return;
    const auto ports = w.ports(block);
    p.at = block + "." + (ports.size() > 1 ? ports.front() : "in");
    p.wire = w.signal(w.diagram().blocks.find(block)->in.front().from);
    p.on = where;
  }
}

/// Blocks beside who reads it there go on from this wire.
bool moves_blocks(const Wiring& w, const std::string& wire) {
  const auto followers = w.followers(wire);
  return followers.size() > 1 && std::any_of(followers.begin(), followers.end(), [&](const Reader& r) {
           return !r.block.empty() && !w.is_inserted(r.block) && w.body(r.block)->type != "mux";
         });
}

}  // namespace

const std::string* output_of_reading(const Diagram& diagram, const std::string& at) {
  if (!at.starts_with(outputs_prefix)) return nullptr;
  for (const auto& [name, from] : diagram.outputs)
    if (name == at.substr(outputs_prefix.size())) return &from;
  return nullptr;
}

Place place_of_reading(const Wiring& w, const std::string& output) {
  Place p;
  p.kind = "measured";
  p.at = p.reading = std::string(outputs_prefix) + output;
  p.wire = w.signal(*w.diagram().outputs.find(output));
  for (auto& group : p.group) group = p.at;
  return p;
}

std::vector<Place> measured_places(const Wiring& w, const Registry& registry, const Reading& reading,
                                   bool behind_offset) {
  const std::string wire = without_effects(w, reading.wire);
  if (wire.find('[') == std::string::npos && moves_blocks(w, wire)) {
    Place p;
    if (reading.by.block.empty()) {
      p = place_of_reading(w, reading.by.output);
      if (!behind_offset) go_before_offsets(w, p);
    } else {
      p.kind = "measured";
      p.at = fmt::format("{}.in[{}]", reading.by.block, reading.by.index);
      p.wire = reading.wire;
      p.reading = reading.by.block;
      for (auto& group : p.group) group = p.at;
    }
    std::vector<Place> both{std::move(p)};
    if (is_controlled(w, registry, wire)) {
      both.push_back(on_wire(w, registry, "measured", wire, behind_offset));
      set_groups(w, both.back());
    }
    return both;
  }
  Place p = on_wire(w, registry, "measured",
                    start_of_chain(w, behind_offset ? reading.wire : before_offset(w, reading.wire)), behind_offset);
  set_groups(w, p);
  return {std::move(p)};
}

namespace {

/// The unit in which a number of a block is written, be it a parameter of the diagram; "" = none.
std::string unit_written(const Diagram& diagram, const Node& body, const std::string& parameter) {
  const Value* given = body.parameters.find(parameter);
  if (given == nullptr) given = body.parameters_from_file.find(parameter);
  for (int depth = 0; given != nullptr && depth < 64; ++depth) {
    if (const auto* number = std::get_if<Number>(&given->content)) return number->unit.value_or("");
    const auto* reference = std::get_if<Reference>(&given->content);
    const auto* named = reference == nullptr ? nullptr : diagram.parameters.find(reference->name);
    given = named == nullptr ? nullptr : &named->value;
  }
  return "";
}

}  // namespace

bool is_damping(const Wiring& w, const std::string& block) {
  const Node* body = w.body(block);
  if (body == nullptr || body->type != "gain" || w.diagram().blocks.find(block)->in.size() != 1) return false;
  const Dimension of_gain = parse_unit(unit_written(w.diagram(), *body, "gain")).dimension;
  const auto is = [&](const char* unit) { return dimension_factor(of_gain, parse_unit(unit).dimension) != 0; };
  return is("N s/m") || is("N m s/rad");
}

Place place_of_damping(const Wiring& w, const std::string& block) {
  Place p;
  p.kind = "damping";
  p.at = block + ".in";
  p.wire = w.signal(w.diagram().blocks.find(block)->in.front().from);
  p.reading = block;
  for (auto& group : p.group) group = p.at;
  return p;
}

Place seen_from_outside(Place place, const std::string& block) {
  place.at = block + "/" + place.at;
  place.wire = block + "/" + place.wire;
  if (!place.reading.empty()) place.reading = block + "/" + place.reading;
  for (auto& group : place.group) group = block + "/" + group;
  return place;
}

std::vector<Place> damping_places(const Wiring& w, const Registry& registry) {
  std::vector<Place> list;
  for (const auto& [block, node] : w.diagram().blocks) {
    const Node* body = w.body(block);
    const auto outputs = w.outputs_of(block);
    if (body == nullptr ||
        std::none_of(outputs.begin(), outputs.end(), [&](const std::string& s) { return w.reaches_output(s); }))
      continue;
    if (body->nested)
      for (auto& place : damping_places(Wiring(*body->nested, registry), registry))
        list.push_back(seen_from_outside(std::move(place), block));
    else if (is_damping(w, block))
      list.push_back(place_of_damping(w, block));
  }
  return list;
}

void set_groups(const Wiring& w, Place& place) {
  for (const auto law : {Commutes::nothing, Commutes::gains, Commutes::linear, Commutes::time_invariant})
    place.group[static_cast<int>(law)] = w.root(w.signal(place.wire), law);
}

}  // namespace hysteron
