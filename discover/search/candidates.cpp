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

/// The place moves something that was measured, and of that none but these outputs; any will do where none is named.
bool may_stand(const SearchState& state, const Place& place, const Names& outputs) {
  auto moved = outputs_moved(state, state.current, place.moves_from());
  if (moved.empty()) return outputs.empty();
  std::erase_if(moved, [&](const std::string& o) { return !contains(state.base_model->outputs(), o); });
  return !moved.empty() && (outputs.empty() || std::all_of(moved.begin(), moved.end(),
                                                           [&](const std::string& o) { return contains(outputs, o); }));
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

}  // namespace

bool standing(const SearchState& state, const Effect& e) {
  if (e.side == Side::other_axis) return false;  // each axis has its own; a wire that has it is left out by places_of
  return std::any_of(state.current.placed.begin(), state.current.placed.end(),
                     [&](const PlacedEffect& s) { return s.effect->family == e.family; });
}

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

bool taken_up(const SearchState& state, const Effect& effect) {
  return std::any_of(state.current.placed.begin(), state.current.placed.end(),
                     [&](const PlacedEffect& s) { return look_alike(*s.effect, effect); });
}

TriedEffect* same_finding(std::vector<TriedEffect>& kept, const TriedEffect& t) {
  if (t.effect->commutes == Commutes::nothing) return nullptr;
  for (auto& k : kept)
    if (k.twin < 0 && k.effect->family == t.effect->family && k.effect->commutes == t.effect->commutes &&
        !k.place.group_for(*k.effect).empty() && k.place.group_for(*k.effect) == t.place.group_for(*t.effect))
      return &k;
  return nullptr;
}

namespace {

/// Outputs that none of the chosen effects moves.
template <class Chosen>
Names outputs_not_moved(const SearchState& state, const Chosen& chosen) {
  Names list = state.base_model->outputs();
  for (const auto& s : state.current.placed) {
    if (!chosen(s)) continue;
    const auto by_it = outputs_moved(state, state.current, s.place.moves_from());
    if (by_it.empty()) return {};  // nobody knows which
    std::erase_if(list, [&](const std::string& o) { return contains(by_it, o); });
  }
  return list;
}

}  // namespace

std::vector<std::string> untouched_outputs(const SearchState& state) {
  return outputs_not_moved(state, [](const PlacedEffect&) { return true; });
}

std::vector<std::string> outputs_without(const SearchState& state, const std::string& family) {
  return outputs_not_moved(state, [&](const PlacedEffect& s) { return s.effect->family == family; });
}

int found_effects(const SearchState& state) {
  std::set<std::string> names;
  for (const auto& s : state.current.placed) names.insert(s.effect->id);
  return static_cast<int>(names.size());
}

namespace {

/// Every effect at every place where it may enter, with what the recordings show there.
std::vector<TriedEffect> everywhere(SearchState& state, int step, const Names& outputs,
                                    const std::vector<const Effect*>& only) {
  std::vector<TriedEffect> list;
  std::vector<Place> places;
  for (const auto& e : state.effects.list()) {
    if (!state.wanted(e) || (!only.empty() && std::find(only.begin(), only.end(), &e) == only.end())) continue;
    auto where = places_of(e, state.current.diagram, state.registry, state.data.get());
    std::erase_if(where, [&](const Place& p) {
      return standing_before(state, state.current, e, p) || !may_stand(state, p, outputs);
    });
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
bool seen_a_little(const SearchState& state, const TriedEffect& t) {
  const bool beside_what_rests =
      t.effect->side != Side::none && !(t.excitation.side_highest > t.excitation.side_lowest);
  return state.by_score && t.effect->seen_by_degrees && !beside_what_rests;
}

}  // namespace

std::vector<TriedEffect> list_candidates(SearchState& state, int step, const std::vector<std::string>& outputs,
                                         const std::vector<const Effect*>& only) {
  state.hidden.clear();
  std::vector<TriedEffect> kept;
  for (auto& t : everywhere(state, step, outputs, only)) {
    if (const std::string why = t.effect->unseen(t.excitation); !why.empty() && !seen_a_little(state, t)) {
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

std::vector<Choice> choices_on(const SearchState& state, const CandidateModel& model,
                               const std::function<bool(const Effect&)>& may,
                               const std::function<std::vector<Law>(const Effect&, const Excitation&)>& laws) {
  std::vector<Choice> list;
  for (const auto& e : state.effects.list()) {
    if (!state.wanted(e) || !may(e)) continue;
    auto places = places_of(e, model.diagram, state.registry, state.data.get());
    std::erase_if(places, [&](const Place& p) { return standing_before(state, model, e, p); });
    if (places.empty()) continue;
    const auto at = circumstances_on(state, model, places);
    for (std::size_t p = 0; p < places.size(); ++p) {
      if (!e.unseen(at[p]).empty()) continue;
      for (auto& law : laws(e, at[p])) list.push_back({&e, std::move(law), places[p], at[p]});
    }
  }
  return list;
}

double blur(const CandidateModel& c) {
  const double n = c.error_of.n();
  return rules::of_noise * (rules::of_noise * n + 2 * std::sqrt(n));
}

void join_twins(std::vector<TriedEffect>& tried) {
  for (std::size_t i = 0; i < tried.size(); ++i) {
    if (tried[i].twin < 0) continue;
    TriedEffect& first = tried[static_cast<std::size_t>(tried[i].twin)];
    TriedEffect& second = tried[i];
    std::erase(first.same_places, second.place.where());
    if (second.candidate.ok &&
        (!first.candidate.ok || second.candidate.score() < first.candidate.score() + blur(first.candidate))) {
      first.same_places.push_back(first.place.where());
      std::swap(first.place, second.place);
      std::swap(first.excitation, second.excitation);
      std::swap(first.laws, second.laws);
      std::swap(first.law, second.law);
      std::swap(first.candidate, second.candidate);
      std::swap(first.laws_tried, second.laws_tried);
    } else {
      first.same_places.push_back(second.place.where());
    }
  }
  std::erase_if(tried, [](const TriedEffect& t) { return t.twin >= 0; });
}

}  // namespace hysteron
