// Decides whether an effect that was found on the way to one output acts on the way to the others: axes are built alike
// and stand in one room, and one that is looked for on each axis in turn uses up the steps that others need.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "discover/search/laws_tried.h"
#include "discover/search/search_state.h"

namespace hysteron {
namespace {

const Effect* standing_effect(const SearchState& state, const std::string& id) {
  for (const auto& s : state.current.placed)
    if (s.effect->id == id) return s.effect;
  return nullptr;
}

/// Fall by a candidate alone, of what ties are counted in.
double gain_of(const TriedEffect& t) {
  return t.fall_train + t.fall_validate - 2 * static_cast<double>(own_values(t).size());
}

/// Who else was tried on the same outputs and explains them better, by more than a tie: axes are built alike; nullptr
/// if nobody does.
const TriedEffect* better_there(const TriedEffect& t, const std::vector<TriedEffect>& others) {
  for (const auto& o : others)
    if (o.admitted && o.effect->family != t.effect->family && o.outputs == t.outputs &&
        gain_of(o) > gain_of(t) + rules::tie + lost_by_the_fit(t))
      return &o;
  return nullptr;
}

/// The effect, and those that could not be told from it where it was found.
std::vector<const Effect*> with_rivals(const SearchState& state, const Effect& effect) {
  std::vector<const Effect*> list{&effect};
  for (const auto& s : state.d.steps)
    if (s.winner.effect == effect.id)
      for (const auto& tie : s.ties)
        if (const Effect* rival = state.effects.find(tie.effect);
            rival != nullptr && std::find(list.begin(), list.end(), rival) == list.end())
          list.push_back(rival);
  return list;
}

/// Fits each on the way to these outputs.
std::vector<TriedEffect> tried_on(SearchState& state, const std::vector<std::string>& outputs,
                                  const std::vector<const Effect*>& effects, int step, double progress) {
  auto tried = list_candidates(state, step, outputs, effects);
  state.side_by_side(tried.size(), [&](std::size_t i, const FitContext& context) {
    TriedEffect& t = tried[i];
    state.progress(t.effect->id + " at " + t.place.where(), progress);
    for (const Law& law : laws_as_found(state, *t.effect, t.laws)) {
      CandidateModel c = with_effect(context, state.current, *t.effect, law, t.place, t.excitation, Effort::full);
      const bool stays = t.candidate.ok && (!c.ok || c.score() >= t.candidate.score());
      TriedLaw one = tried_law(law, c, state.current.error_of);
      one.taken = c.ok && !stays;
      if (c.ok && stays) one.reason = why_no_better(c, t.candidate, t.laws[t.law], 0);
      record(t.laws_tried, std::move(one));
      if (stays) continue;
      t.candidate = std::move(c);
      t.law = static_cast<std::size_t>(
          std::find_if(t.laws.begin(), t.laws.end(), [&](const Law& l) { return l.name == law.name; }) -
          t.laws.begin());
    }
    return false;
  });
  join_twins(tried);
  compare_all(state, tried, As::first);
  enrich(state, tried, step, As::first, progress);
  return tried;
}

/// The best place of the effect, -1 where it is not admitted or somebody else explains that output better.
int best_place(const SearchState& state, std::vector<TriedEffect>& tried, const Effect& effect,
               const std::vector<TriedEffect>& others) {
  for (auto& t : tried) {
    if (!t.admitted || t.effect != &effect) continue;
    const TriedEffect* other = better_there(t, others);
    if (other == nullptr) other = better_there(t, tried);
    if (other == nullptr) continue;
    t.admitted = false;
    t.reason = other->effect->id + " explains that output better";
  }
  for (const std::size_t i : ranking(tried))
    if (tried[i].admitted && tried[i].effect == &effect && stays_itself(state, tried[i])) return static_cast<int>(i);
  return -1;
}

}  // namespace

std::vector<Law> laws_as_found(const SearchState& state, const Effect& effect, const std::vector<Law>& laws) {
  std::vector<Law> list{laws.begin(), laws.begin() + std::min<std::ptrdiff_t>(1, std::ssize(laws))};
  for (const auto& s : state.current.placed)
    for (std::size_t law = 1; s.effect == &effect && law < laws.size() && list.size() < 2; ++law)
      if (laws[law].name == s.law.name) list.push_back(laws[law]);
  for (Law& law : list)
    for (std::size_t i = 0; i < state.current.placed.size(); ++i) {
      if (state.current.placed[i].effect != &effect) continue;
      for (const auto& p : parameters_of(state.current, static_cast<int>(i)))
        for (auto& q : law.free)
          if (p.estimate != nullptr && !p.estimate->linear && q.path == p.law->path)
            q.scan = {p.estimate->used, q.start};
      break;
    }
  return list;
}

void on_other_outputs(SearchState& state, const std::string& id, const std::vector<TriedEffect>& others_tried,
                      double progress) {
  if (state.base_model->outputs().size() < 2) return;
  while (!state.stopped()) {
    const Effect* effect = standing_effect(state, id);
    if (effect == nullptr) return;
    const auto others = outputs_without(state, effect->family);
    if (others.empty()) return;
    const int step = static_cast<int>(state.d.steps.size()) + 1;
    auto tried = tried_on(state, others, with_rivals(state, *effect), step, progress);
    const int winner = best_place(state, tried, *effect, others_tried);
    std::vector<int> ties;
    if (winner >= 0) {
      // What one axis cannot tell another one may.
      const auto index = static_cast<std::size_t>(winner);
      try_hidden(state, tried, *effect, As::first);
      ties = ties_of(state, tried, index);
      claim(state, step, tried, index, ties, progress);
    }
    keep_candidates(state, tried, step, winner, ties);
    if (winner < 0) return;
  }
}

}  // namespace hysteron
