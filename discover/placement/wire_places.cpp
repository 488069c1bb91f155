#include "discover/placement/wire_places.h"

#include <algorithm>
#include <initializer_list>

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

}  // namespace

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

std::string start_of_chain(const Wiring& w, const std::string& signal) {
  for (const auto& s : w.signals()) {
    const auto chain = w.chain(s);
    if (!chain.empty() && chain.back() == signal) return s;
  }
  return signal;
}

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

}  // namespace hysteron
