// Decides which effects are tried at which places in a step: all that could be seen; places that a law cannot tell
// apart once.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "discover/models/parts.h"
#include "discover/placement/excitation.h"
#include "discover/placement/visible.h"
#include "discover/placement/wire_places.h"
#include "discover/search/search_state.h"
#include "discover/structure/residual_parts.h"
#include "discover/structure/structure_lines.h"
#include "discover/wiring/wiring.h"

namespace hysteron {
namespace {

using Names = std::vector<std::string>;

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The place moves something that was measured, or nobody knows what.
bool may_stand(const SearchState& state, const Place& place) {
  const auto moved = outputs_moved(state, state.current, place.moves_from());
  return moved.empty() || std::any_of(moved.begin(), moved.end(),
                                      [&](const std::string& o) { return contains(state.base_model->outputs(), o); });
}

/// The two strongest lines of each output that the place moves [Hz].
std::vector<double> lines_left(const SearchState& state, const TriedEffect& t,
                               const std::vector<std::pair<double, double>>& bands) {
  std::vector<double> lines;
  for (std::size_t o = 0; o < state.base_model->outputs().size(); ++o) {
    if (!t.outputs.empty() && !contains(t.outputs, state.base_model->outputs()[o])) continue;
    const ResidualParts parts(*state.evidence, state.current.prediction, static_cast<int>(o));
    for (const double f : strongest_lines(parts, bands, 2)) lines.push_back(f);
  }
  return lines;
}

/// A frequency is sought in what the present model leaves: a fit from anywhere else sees the next side lobe only.
void begin_at_lines(const SearchState& state, TriedEffect& t) {
  std::map<std::vector<std::pair<double, double>>, std::vector<double>> lines;  // by their bands
  for (auto& law : t.laws)
    for (auto& p : law.free) {
      if (p.line_bands.empty()) continue;
      const auto [found, is_new] = lines.try_emplace(p.line_bands);
      if (is_new) found->second = lines_left(state, t, p.line_bands);
      if (!found->second.empty()) p.scan = found->second;
    }
}

/// Periods of the strongest ripples of each output that the place moves, over that output.
std::vector<double> ripples_left(const SearchState& state, const TriedEffect& t, const LawParameter& period) {
  constexpr std::size_t most = 4;  // the lowest may be a trend
  std::vector<double> periods;
  for (std::size_t o = 0; o < state.base_model->outputs().size(); ++o) {
    if (!t.outputs.empty() && !contains(t.outputs, state.base_model->outputs()[o])) continue;
    const ResidualParts parts(*state.evidence, state.current.prediction, static_cast<int>(o));
    if (parts.levels().empty()) continue;
    for (const double p : strongest_ripples(parts, 0, period.lower, period.upper, most)) periods.push_back(p);
  }
  return periods;
}

/// So is a period in the signal of the wire.
void begin_at_ripples(const SearchState& state, TriedEffect& t) {
  for (auto& law : t.laws)
    for (auto& p : law.free)
      if (p.period_of_wire)
        if (auto periods = ripples_left(state, t, p); !periods.empty()) p.scan = std::move(periods);
}

/// Do two effects vary two blocks: of two tanks in a row, or of two masses, each has its own, and so has each memory
/// its past.
bool in_another_block(const Effect& a, const Place& at_a, const Effect& b, const Place& at_b) {
  const auto varies = [](const Effect& e, const Place& at) { return e.way == Way::vary || !at.by.empty(); };
  return varies(a, at_a) && varies(b, at_b) && at_a.at != at_b.at;
}

/// One of its family stands in the present model.
bool standing(const SearchState& state, const Effect& e) {
  if (e.side == Side::other_axis) return false;  // each axis has its own; a wire that has it is left out by places_of
  return std::any_of(state.current.placed.begin(), state.current.placed.end(),
                     [&](const PlacedEffect& s) { return s.effect->family == e.family; });
}

/// One of its family stands in this model on the way to an output that the place moves: each axis has its own.
bool standing_before(const SearchState& state, const CandidateModel& model, const Effect& e, const Place& place) {
  if (e.side == Side::other_axis) return false;
  const auto here = outputs_moved(state, model, place.moves_from());
  return std::any_of(model.placed.begin(), model.placed.end(), [&](const PlacedEffect& s) {
    if (s.effect->family != e.family || in_another_block(*s.effect, s.place, e, place)) return false;
    const auto there = outputs_moved(state, model, s.place.moves_from());
    return there.empty() || here.empty() ||
           std::any_of(here.begin(), here.end(), [&](const std::string& o) { return contains(there, o); });
  });
}

/// The candidate of the same family whose law cannot tell its place from that of `t`; nullptr if there is none.
TriedEffect* same_finding(std::vector<TriedEffect>& kept, const TriedEffect& t) {
  if (t.effect->commutes == Commutes::nothing) return nullptr;
  for (auto& k : kept)
    if (k.twin < 0 && k.effect->family == t.effect->family && k.effect->commutes == t.effect->commutes &&
        !k.place.group_for(*k.effect).empty() && k.place.group_for(*k.effect) == t.place.group_for(*t.effect))
      return &k;
  return nullptr;
}

/// Every effect at every place where it may enter, with what the recordings show there.
std::vector<TriedEffect> everywhere(SearchState& state, int step) {
  std::vector<TriedEffect> list;
  std::vector<Place> places;
  for (const auto& e : state.effects.list()) {
    if (!state.wanted(e)) continue;
    auto where = places_of(e, state.current.diagram, state.registry, state.data.get());
    std::erase_if(where,
                  [&](const Place& p) { return standing_before(state, state.current, e, p) || !may_stand(state, p); });
    if (where.empty() && standing(state, e)) continue;
    if (where.empty() && step == 1) state.d.refused.push_back({e.id, "", why_no_place(e, state.registry)});
    for (const auto& p : where) {
      TriedEffect t;
      t.effect = &e;
      t.place = p;
      list.push_back(std::move(t));
      places.push_back(p);
    }
  }
  if (list.empty()) return list;
  auto seen = circumstances_on(state, state.current, places);
  for (std::size_t i = 0; i < list.size(); ++i) list[i].excitation = std::move(seen[i]);
  return list;
}

/// Beside the candidate that stands for it already: a further place, or a twin.
void add_to(TriedEffect& same, TriedEffect t, std::vector<TriedEffect>& kept) {
  if (same.effect != t.effect) same.same_effects.push_back(t.effect->id);
  same.same_places.push_back(t.place.where());
  // A delay is best put where the signal is smooth: behind the plant, not on a drive with corners between rows; it is
  // fitted at both ends all the same, for what lies between may be rougher than the drive.
  if (same.effect != t.effect || t.effect->commutes != Commutes::time_invariant) return;
  t.twin = static_cast<int>(&same - kept.data());
  kept.push_back(std::move(t));
}

}  // namespace

std::vector<Excitation> circumstances_on(const SearchState& state, const CandidateModel& model,
                                         const std::vector<Place>& places) {
  auto seen = circumstances_at(model.diagram, state.registry, *state.data, places, free_anyway(state.context, model));
  if (!model.placed.empty())
    for (auto& c : seen) c.own_resonances = state.own_resonances;
  return seen;
}

std::vector<std::string> outputs_moved(const SearchState& state, const CandidateModel& model,
                                       const std::string& written) {
  const Program& p = *model.program;
  std::vector<std::string> list;
  if (written.find('/') == std::string::npos) {
    const Wiring w(model.diagram, *state.context.registry);
    if (output_of_reading(model.diagram, written) != nullptr) {
      std::copy_if(p.output_names.begin(), p.output_names.end(), std::back_inserter(list),
                   [&](const std::string& name) { return is_of_output(name, written.substr(written.find('.') + 1)); });
      return list;
    }
    for (const auto& output : w.outputs_on_the_way(w.signal(written)))
      std::copy_if(p.output_names.begin(), p.output_names.end(), std::back_inserter(list),
                   [&](const std::string& name) { return is_of_output(name, output); });
    return list;
  }
  const std::string wire = program_signal(model.diagram, *state.context.registry, written);
  int signal = p.find_signal(wire);
  if (signal < 0) signal = p.find_signal(wire + "[0]");
  if (signal < 0) return {};
  for (const int o : outputs_behind(p, p.signals[static_cast<std::size_t>(signal)].block))
    list.push_back(p.output_names[static_cast<std::size_t>(o)]);
  return list;
}

std::vector<int> measured_moved(const SearchState& state, const CandidateModel& model, const std::string& written) {
  const auto moved = outputs_moved(state, model, written);
  const auto& outputs = state.base_model->outputs();
  std::vector<int> list;
  for (int o = 0; o < static_cast<int>(outputs.size()); ++o)
    if (contains(moved, outputs[static_cast<std::size_t>(o)])) list.push_back(o);
  return list;
}

namespace {

/// Little is seen of it, and the score says what that is worth.
bool seen_a_little(const TriedEffect& t) {
  const bool beside_what_rests =
      t.effect->side != Side::none && !(t.excitation.side_highest > t.excitation.side_lowest);
  return t.effect->seen_by_degrees && !beside_what_rests;
}

}  // namespace

std::vector<TriedEffect> list_candidates(SearchState& state, int step) {
  state.hidden.clear();
  std::vector<TriedEffect> kept;
  for (auto& t : everywhere(state, step)) {
    if (const std::string why = t.effect->unseen(t.excitation); !why.empty() && !seen_a_little(t)) {
      if (step == 1) state.d.refused.push_back({t.effect->id, t.place.where(), why});
      if (t.effect->may_hide && t.effect->may_hide(t.excitation)) state.hidden.push_back(std::move(t));
      continue;
    }
    t.laws = t.effect->laws(t.excitation);
    if (t.laws.empty() || t.laws.front().free.empty()) continue;
    if (TriedEffect* same = same_finding(kept, t))
      add_to(*same, std::move(t), kept);
    else
      kept.push_back(std::move(t));
  }
  for (auto* list_of : {&kept, &state.hidden})
    for (auto& t : *list_of) {
      t.outputs = outputs_moved(state, state.current, t.place.moves_from());
      begin_at_lines(state, t);
      begin_at_ripples(state, t);
    }
  return kept;
}

}  // namespace hysteron
