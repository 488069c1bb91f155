// Decides where in a diagram an effect may enter. Order of kinds along the signal: command, core, measured.
#include "discover/placement/places.h"

#include <fmt/format.h>

#include <algorithm>

#include "discover/hypotheses/effect.h"
#include "discover/placement/wire_places.h"
#include "discover/wiring/wiring.h"
#include "engine/diagram/error.h"
#include "io/diagram/place_kinds.h"

namespace hysteron {
namespace {

class Finder {
 public:
  Finder(const Diagram& diagram, const Registry& registry) : w_(diagram, registry), registry_(registry) {}

  std::vector<Place> find() {
    for (const auto& kind : place_kinds) {
      if (const auto* named = w_.diagram().places.find(kind))
        from_diagram(kind, *named);
      else if (kind == "command")
        commands();
      else if (kind == "core")
        cores();
      else if (kind == "measured")
        measured();
      else if (kind == "damping")
        for (auto& place : damping_places(w_, registry_)) add(std::move(place));
    }
    return std::move(places_);
  }

 private:
  void add(Place place) {
    if (place.reading.empty()) set_groups(w_, place);
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
    for (const auto& reading : readings(w_))
      for (auto& place : measured_places(w_, registry_, reading, false)) add(std::move(place));
  }

  /// Before and behind each block of the user's with memory; where there is none, before and behind the whole chain.
  /// What was found says nothing about where else something may enter: effects that were added do not count, and a
  /// block that one gave another law counts as it was.
  void cores() {
    bool any = false;
    for (const auto& [name, node] : w_.diagram().blocks) {
      if (w_.is_inserted(name) || !w_.had_memory(name) || node.in.empty() || w_.outputs_of(name).empty() ||
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
    for (const auto& reading : readings(w_)) {
      for (auto& place : measured_places(w_, registry_, reading, false)) {
        if (place.reading.empty()) continue;
        place.kind = "core";  // between what moves and where it is read
        place.behind_core = true;
        add(std::move(place));
      }
      Place behind = on_wire(w_, registry_, "core", start_of_chain(w_, before_offset(w_, reading.wire)));
      behind.behind_core = true;
      add(std::move(behind));
    }
  }

  Wiring w_;
  const Registry& registry_;
  std::vector<Place> places_;
};

}  // namespace

std::vector<Place> find_places(const Diagram& diagram, const Registry& registry) {
  return Finder(diagram, registry).find();
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
    return seen_from_outside(place_at(*node->nested, registry, at.substr(slash + 1)), head);
  }
  Place p;
  p.at = at;
  const std::string signal = w.signal(at);
  if (signal.empty() && output_of_reading(diagram, at) != nullptr)
    return place_of_reading(w, at.substr(at.find('.') + 1));
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
    if (!p.wire.empty() && is_damping(w, block)) return place_of_damping(w, block);
  }
  if (p.wire.empty()) {
    auto known = w.signals();
    for (const auto& [name, node] : diagram.blocks)
      if (node.in.size() == 1) known.push_back(name + ".in");
    for (const auto& [name, from] : diagram.outputs) known.push_back("outputs." + name);
    fail("unknown_place", at,
         fmt::format("\"{}\" is neither a signal, an input port nor the reading of an output of the diagram", at),
         did_you_mean(at, known));
  }
  set_groups(w, p);
  return p;
}

}  // namespace hysteron
