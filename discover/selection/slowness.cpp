#include "discover/selection/slowness.h"

#include <set>
#include <string>
#include <vector>

#include "discover/wiring/wiring.h"

namespace hysteron {
namespace {

/// Does what the place moves come back to it?
bool is_in_a_loop(const Wiring& w, const std::string& signal) {
  if (w.signal(signal).empty()) return false;  // what is read off a wire
  std::set<std::string> seen;
  std::vector<std::string> next{w.signal(signal)};
  while (!next.empty()) {
    const std::string now = next.back();
    next.pop_back();
    for (const auto& reader : w.readers(now))
      for (const auto& out : reader.block.empty() ? std::vector<std::string>{} : w.outputs_of(reader.block)) {
        if (out == w.signal(signal)) return true;
        if (seen.insert(out).second) next.push_back(out);
      }
  }
  return false;
}

}  // namespace

int slowness(const SearchState& state, const TriedEffect& t) {
  constexpr std::size_t several = 4;
  if (t.effect->is_memory && !t.place.by.empty()) return t.laws.front().free.size() > several ? slowest : 0;
  const bool on_a_wire = t.place.by.empty() && t.effect->way == Way::insert;
  const bool nested = t.place.wire.find('/') != std::string::npos || t.place.wire.empty();
  if (!on_a_wire || nested || !is_in_a_loop(Wiring(state.current.diagram, state.registry), t.place.moves_from()))
    return 0;
  const Kernel* law = state.registry.find(t.laws.front().block.type);
  return law != nullptr && (law->advance != nullptr || law->reach_back != nullptr || law->uses_time) ? slowest : 1;
}

}  // namespace hysteron
