// Decides whether what was found on the way to one output acts on the way to another one as a set: axes are built alike
// and stand in one room, and what alone is a patch there may explain that output together.
#include <algorithm>
#include <optional>

#include "discover/search/search_state.h"

namespace hysteron {
namespace {

/// Effects that stand, none of whose family moves this output.
std::vector<const Effect*> missing_on(const SearchState& state, const std::string& output) {
  std::vector<const Effect*> list;
  for (const auto& s : state.current.placed) {
    if (s.effect->side == Side::other_axis || std::find(list.begin(), list.end(), s.effect) != list.end()) continue;
    const auto without = outputs_without(state, s.effect->family);
    if (std::find(without.begin(), without.end(), output) != without.end()) list.push_back(s.effect);
  }
  return list;
}

/// `model` with the effect at the best place on the way to this output alone, by the laws by which it stands elsewhere.
std::optional<TriedEffect> with_effect_on(const SearchState& state, const CandidateModel& model, const Effect& effect,
                                          const std::string& output, double progress) {
  auto list = choices_on(
      state, model, [&](const Effect& e) { return &e == &effect; },
      [&](const Effect& e, const Excitation& at) { return laws_as_found(state, e, e.laws(at)); });
  std::erase_if(list, [&](const Choice& c) {
    const auto moved = measured_moved(state, model, c.place.moves_from());
    return moved.size() != 1 || state.base_model->outputs()[static_cast<std::size_t>(moved.front())] != output;
  });
  std::vector<TriedEffect> fitted(list.size());
  state.side_by_side(list.size(), [&](std::size_t i, const FitContext& context) {
    TriedEffect& t = fitted[i];
    state.progress(effect.id + ", with what stands on another axis, at " + list[i].place.where(), progress);
    t.effect = &effect;
    t.place = list[i].place;
    t.excitation = list[i].at;
    t.laws = {list[i].law};
    t.outputs = {output};
    t.candidate = with_effect(context, model, effect, list[i].law, list[i].place, list[i].at, Effort::full);
    t.admitted = t.candidate.ok && why_implausible(effect, list[i].law, t.candidate, list[i].at).empty();
    return false;
  });
  const int best = best_admitted(fitted);
  if (best < 0) return std::nullopt;
  TriedEffect t = std::move(fitted[static_cast<std::size_t>(best)]);
  t.candidate.error_of = state.evidence->error(t.candidate.prediction);
  return t;
}

/// All of them, each on top of those before it; empty where one cannot be had.
std::vector<TriedEffect> all_on(const SearchState& state, const std::vector<const Effect*>& effects,
                                const std::string& output, double progress) {
  std::vector<TriedEffect> set;
  for (const Effect* e : effects) {
    if (state.stopped()) return {};
    auto t = with_effect_on(state, set.empty() ? state.current : set.back().candidate, *e, output, progress);
    if (!t) return {};
    set.push_back(std::move(*t));
  }
  return set;
}

double excess_on(const ModelError& error, const std::string& output) {
  double excess = 0;
  for (const auto& r : error.recordings)
    if (r.role == Role::validate && r.output == output) excess += r.excess();
  return excess;
}

/// On recordings not used for the fit it is no chance, and it is worth its numbers.
bool speaks_for(const CandidateModel& before, const CandidateModel& after) {
  return before.error_of.evidence_validate - after.error_of.evidence_validate > rules::claim_fall &&
         after.score() < before.score();
}

/// As a first effect has to, the set takes most of what stands above the noise there, and none of it is needless.
bool belongs_there(const SearchState& state, const std::vector<TriedEffect>& set, const std::string& output,
                   double progress) {
  const CandidateModel& all = set.back().candidate;
  const double excess = excess_on(state.current.error_of, output);
  if (!speaks_for(state.current, all) || excess - excess_on(all.error_of, output) < rules::share_of_first * excess)
    return false;
  for (std::size_t i = 0; i + 1 < set.size(); ++i) {  // what the last one brings is known
    std::vector<const Effect*> others;
    for (std::size_t k = 0; k < set.size(); ++k)
      if (k != i) others.push_back(set[k].effect);
    const auto rest = all_on(state, others, output, progress);
    if (!rest.empty() && !speaks_for(rest.back().candidate, all)) return false;
  }
  return speaks_for(set[set.size() - 2].candidate, all);
}

}  // namespace

bool as_a_set_on_another_output(SearchState& state, double progress) {
  const auto outputs = state.base_model->outputs();
  if (outputs.size() < 2) return false;
  state.current.error_of = state.evidence->error(state.current.prediction);
  for (const auto& output : outputs) {
    const auto effects = missing_on(state, output);
    // One alone was asked for when it was found.
    if (effects.size() < 2 || !(excess_on(state.current.error_of, output) > 0)) continue;
    auto set = all_on(state, effects, output, progress);
    if (set.empty() || !belongs_there(state, set, output, progress)) continue;
    sharpen(state, set.back());
    for (auto& t : set) {
      const int step = static_cast<int>(state.d.steps.size()) + 1;
      take(state, step, t, {});
      std::vector<TriedEffect> told{t};
      told.front().reason += "; with the others that stand on another axis";
      keep_candidates(state, told, step, 0, {});
    }
    return true;
  }
  return false;
}

}  // namespace hysteron
