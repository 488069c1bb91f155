// Decides where in a diagram an effect may enter. Order of kinds along the signal: command, core, measured (EFFECTS 1).
#include "discover/places.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "discover/effect.h"
#include "discover/wiring.h"
#include "engine/error.h"

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
  const Kernel* k = node != nullptr && !node->nested ? registry.find(node->type) : nullptr;
  if (k != nullptr && !k->declaration.place.empty()) return rank(k->declaration.place);
  return w.has_memory(block) ? rank("core") : -1;
}

/// A place on `wire` for an effect of `kind`: behind the effects that stand there already, but before those that come
/// later along the signal: a lag of the amplifier enters before a hysteresis that was found first, a resonance before
/// the curve of a sensor.
Place on_wire(const Wiring& w, const Registry& registry, const std::string& kind, const std::string& wire) {
  Place p;
  p.kind = kind;
  p.at = p.wire = wire;
  for (const auto& effect : w.chain(wire)) {
    if (rank_of(w, registry, wire, effect) > rank(kind)) {
      const auto ports = w.ports(effect);  // one that reads a second signal names its ports
      p.at = effect + "." + (ports.size() > 1 ? ports.front() : "in");
      p.on = wire;
      return p;
    }
    p.wire = effect;  // add_effect puts it behind the chain: that is the signal that the effect sees
  }
  return p;
}

/// The signal before constant offsets and what a cable picks up: a gain-like effect must not act on the zero of a
/// sensor (DESIGN 5), and nothing in the device delays the mains.
std::string before_offset(const Wiring& w, const std::string& signal) {
  const std::string block = w.source(signal);
  if (block.empty()) return signal;
  const Node* node = w.body(block);
  const auto is_any_of = [&](std::initializer_list<const char*> types) {
    return std::find(types.begin(), types.end(), node->type) != types.end();
  };
  if (node == nullptr || !is_any_of({"calibration", "sum", "mains_interference", "rounding"})) return signal;
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

/// A signal that is the end of a chain of effects, told as the wire on which they stand: "u" rather than
/// "u_hysteresis".
std::string start_of_chain(const Wiring& w, const std::string& signal) {
  for (const auto& s : w.signals()) {
    const auto chain = w.chain(s);
    if (!chain.empty() && chain.back() == signal) return s;
  }
  return signal;
}

/// The wires that are measured: that of each output, or those that a mux bundles for it, each with a law of its own.
std::vector<std::string> measured_wires(const Wiring& w) {
  std::vector<std::string> list;
  for (const auto& [name, from] : w.diagram().outputs) {
    const std::string s = w.signal(from);
    if (s.empty()) continue;
    const std::string begin = start_of_chain(w, s);
    const Node* node = w.outputs_of(begin).empty() ? nullptr : w.body(begin);
    if (node != nullptr && node->type == "mux")
      for (const auto& wire : w.diagram().blocks.find(begin)->in) list.push_back(w.signal(wire.from));
    else
      list.push_back(s);
  }
  return list;
}

void set_groups(const Wiring& w, Place& place) {
  for (const auto law : {Commutes::nothing, Commutes::gains, Commutes::linear, Commutes::time_invariant})
    place.group[static_cast<int>(law)] = w.root(w.signal(place.wire), law);
}

class Finder {
 public:
  Finder(const Diagram& diagram, const Registry& registry) : w_(diagram, registry), registry_(registry) {}

  std::vector<Place> find() {
    for (const std::string kind : {"command", "core", "force", "motion", "measured"}) {
      if (const auto* named = w_.diagram().places.find(kind))
        from_diagram(kind, *named);
      else if (kind == "command")
        commands();
      else if (kind == "core")
        cores();
      else if (kind == "measured")
        measured();
    }
    return std::move(places_);
  }

 private:
  void add(Place place) {
    set_groups(w_, place);
    for (const auto& p : places_)
      if (p.kind == place.kind && p.at == place.at && p.behind_core == place.behind_core) return;
    places_.push_back(std::move(place));
  }

  void from_diagram(const std::string& kind, const std::vector<std::string>& wires) {
    for (const auto& wire : wires) {
      Place p = place_at(w_.diagram(), registry_, wire);
      if (!w_.signal(wire).empty()) p = on_wire(w_, registry_, kind, w_.signal(wire));
      p.kind = kind;
      p.behind_core = true;  // the user named it: whoever enters at the core may enter here
      add(std::move(p));
    }
  }

  std::vector<std::string> drives() const {
    std::vector<std::string> list;
    for (const auto& name : w_.diagram().inputs.names())
      if (w_.reaches_output(name) && !w_.followers(name).empty()) list.push_back(name);
    if (!list.empty()) return list;
    for (const auto& s : w_.signals()) {
      const Node* node = w_.body(w_.source(s));
      if (node != nullptr && w_.diagram().blocks.find(w_.source(s))->in.empty() && !w_.is_constant(s) &&
          w_.reaches_output(s))
        list.push_back(s);
    }
    return list;
  }

  void commands() {
    for (const auto& s : drives()) add(on_wire(w_, registry_, "command", s));
  }

  void measured() {
    for (const auto& s : measured_wires(w_))
      add(on_wire(w_, registry_, "measured", start_of_chain(w_, before_offset(w_, s))));
  }

  /// Before and behind each block with memory; where there is none, before and behind the whole chain. Effects that
  /// were added do not count: what was found says nothing about where else something may enter.
  void cores() {
    bool any = false;
    for (const auto& [name, node] : w_.diagram().blocks) {
      if (!node.effect.empty() || !w_.has_memory(name) || node.in.empty() || w_.outputs_of(name).empty() ||
          !w_.reaches_output(w_.outputs_of(name).front()))
        continue;
      any = true;
      Place before = on_wire(w_, registry_, "core", start_of_chain(w_, w_.signal(node.in.front().from)));
      add(std::move(before));
      for (const auto& s : w_.outputs_of(name)) {
        Place behind = on_wire(w_, registry_, "core", start_of_chain(w_, s));
        behind.behind_core = true;
        add(std::move(behind));
      }
    }
    if (any) return;
    for (const auto& s : drives()) add(on_wire(w_, registry_, "core", s));
    for (const auto& s : measured_wires(w_)) {
      Place behind = on_wire(w_, registry_, "core", start_of_chain(w_, before_offset(w_, s)));
      behind.behind_core = true;
      add(std::move(behind));
    }
  }

  Wiring w_;
  const Registry& registry_;
  std::vector<Place> places_;
};

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
    const Kernel* k = registry.find(body->type);
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
std::vector<std::string> standing_at(const Wiring& w, const Place& place) {
  std::vector<std::string> ids;
  const auto collect = [&](const std::string& wire) {
    for (const auto& name : w.chain(wire)) ids.push_back(w.diagram().blocks.find(name)->effect);
  };
  collect(start_of_chain(w, w.signal(place.wire)));
  return ids;
}

/// True if a block that is its own variation is no longer neutral: a tank with the root of the level in it.
bool has_already(const VariationDeclaration& v, const Node& body) {
  if (v.type != body.type) return false;
  return std::any_of(v.neutral.begin(), v.neutral.end(), [&](const auto& neutral) {
    const Value* given = body.parameters.find(neutral.parameter);
    if (given == nullptr) return false;
    if (const auto* text = std::get_if<std::string>(&given->content)) return *text != neutral.value;
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
    if (node.effect == effect.id || (!node.from.empty() && node.from.find(effect.id) != nullptr)) continue;
    const Kernel* k = registry.find(body->type);
    if (k == nullptr || node.in.empty()) continue;
    for (const auto& v : k->declaration.variations) {
      if (v.name != effect.variation || has_already(v, *body)) continue;
      Place p;
      p.kind = "force";
      p.at = prefix + block;
      p.wire = prefix + w.signal(node.in.front().from);
      p.by = v.type;
      list.push_back(std::move(p));
    }
  }
}

bool is_temperature(const Unit& unit) { return unit.dimension == parse_unit("K").dimension; }

/// True if `to` is made from `from`.
bool leads_to(const Wiring& w, const std::string& from, const std::string& to, int depth = 0) {
  if (from == to) return true;
  const std::string block = w.source(to);
  if (block.empty() || depth > 64) return false;
  const Node* node = w.diagram().blocks.find(block);
  if (node == nullptr) return false;  // a column that the diagram does not read
  const auto& in = node->in;
  return std::any_of(in.begin(), in.end(),
                     [&](const Wire& wire) { return leads_to(w, from, w.signal(wire.from), depth + 1); });
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
    return !is_temperature(unit) && !unit.dimension.none();
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

std::vector<Place> find_places(const Diagram& diagram, const Registry& registry) {
  return Finder(diagram, registry).find();
}

std::vector<Place> places_of(const Effect& effect, const Diagram& diagram, const Registry& registry,
                             const DataSet* data) {
  std::vector<Place> list;
  if (effect.way == Way::vary && effect.variation.empty()) {
    collect_vary(diagram, registry, effect.parameter, "", list);
    return list;
  }
  const Wiring w(diagram, registry);
  if (!effect.variation.empty()) collect_variations(diagram, registry, effect, "", list);
  const bool varied = !list.empty();
  for (auto& place : find_places(diagram, registry)) {
    if (std::find(effect.places.begin(), effect.places.end(), place.kind) == effect.places.end()) continue;
    if (place.kind == "core" && effect.behind_core && !place.behind_core) continue;
    if (place.kind == "core" && effect.else_a_block && varied) continue;
    const auto there = standing_at(w, place);
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
    for (const auto& s : measured_wires(w)) {
      Place p = on_wire(w, registry, "measured", start_of_chain(w, s));
      set_groups(w, p);
      const auto there = standing_at(w, p);
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
    std::erase_if(places, [&](const Place& p) { return p.at != at; });
    if (places.empty()) places = {place_at(diagram, registry, at)};
  } else {
    places = {place_at(diagram, registry, at)};
    if (effect.side != Side::none) places = beside(places, effect, Wiring(diagram, registry), data);
  }
  if (!places.empty()) return places.front();
  if (effect.side != Side::none)
    fail("no_side_signal", effect.id,
         effect.side == Side::use ? "it reads what the device had behind it, and no recording says that"
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

Place place_at(const Diagram& diagram, const Registry& registry, const std::string& at) {
  const auto slash = at.find('/');
  const Wiring w(diagram, registry);
  if (slash != std::string::npos) {
    const std::string head = at.substr(0, slash);
    const Node* node = w.body(head);
    if (node == nullptr || !node->nested)
      fail("unknown_place", at, fmt::format("there is no nested diagram \"{}\"", head),
           did_you_mean(head, diagram.blocks.names()));
    Place p = place_at(*node->nested, registry, at.substr(slash + 1));
    p.at = at;
    p.wire = head + "/" + p.wire;
    for (auto& group : p.group) group = head + "/" + group;
    return p;
  }
  Place p;
  p.at = at;
  const std::string signal = w.signal(at);
  if (!signal.empty()) {
    const auto chain = w.chain(signal);
    p.wire = chain.empty() ? signal : chain.back();
  } else if (const auto dot = at.find('.');
             dot != std::string::npos && diagram.blocks.find(at.substr(0, dot)) != nullptr) {
    const std::string block = at.substr(0, dot);
    const std::string port = at.substr(dot + 1);
    const auto ports = w.ports(block);
    const auto& in = diagram.blocks.find(block)->in;
    for (std::size_t i = 0; i < in.size() && p.wire.empty(); ++i)
      if (ports[i] == port || (port == "in" && in.size() == 1) || port == fmt::format("in[{}]", i))
        p.wire = w.signal(in[i].from);
  }
  if (p.wire.empty()) {
    auto known = w.signals();
    for (const auto& [name, node] : diagram.blocks)
      if (node.in.size() == 1) known.push_back(name + ".in");
    fail("unknown_place", at, fmt::format("\"{}\" is neither a signal nor an input port of the diagram", at),
         did_you_mean(at, known));
  }
  set_groups(w, p);
  return p;
}

}  // namespace hysteron
