// Decides whether an effect too weak to be claimed on the way to one output is claimed on the ways to several at once:
// axes are built alike and stand in one room, and what each alone says hardly more than chance of, all together may.
#include <fmt/format.h>

#include <algorithm>

#include "discover/search/search_state.h"

namespace hysteron {
namespace {

bool on_one_output(const TriedEffect& a, const TriedEffect& b) {
  return a.outputs.empty() || b.outputs.empty() ||
         std::any_of(a.outputs.begin(), a.outputs.end(), [&](const std::string& o) {
           return std::find(b.outputs.begin(), b.outputs.end(), o) != b.outputs.end();
         });
}

/// Every kind of recording speaks for it, if only a little, and it is plausible.
bool agrees(const TriedEffect& t) {
  return t.candidate.ok && t.fall_train > 0 && t.fall_validate > 0 &&
         why_implausible(*t.effect, t.laws[t.law], t.candidate, t.excitation).empty();
}

/// The best candidates of the effect that begins with `i` of this order, one for each output.
std::vector<const TriedEffect*> of_one_effect(const std::vector<TriedEffect>& tried,
                                              const std::vector<std::size_t>& order, std::size_t i) {
  std::vector<const TriedEffect*> members;
  for (std::size_t k = i; k < order.size(); ++k) {
    const TriedEffect& t = tried[order[k]];
    if (t.effect != tried[order[i]].effect || !agrees(t)) continue;
    if (std::none_of(members.begin(), members.end(), [&](const TriedEffect* m) { return on_one_output(*m, t); }))
      members.push_back(&t);
  }
  return members;
}

/// Separate outputs: what each takes away adds up, and what cannot suffice is not fitted.
bool could_suffice(const SearchState& state, const std::vector<const TriedEffect*>& members) {
  double score = 0, fall = 0, beginnings = 1;
  int numbers = 0;
  for (const TriedEffect* m : members) {
    score += state.current.score() - m->candidate.score();
    fall += m->fall_train + m->fall_validate;
    numbers += m->candidate.parameters - state.current.parameters;
    beginnings *= beginnings_of(m->laws[m->law]);
  }
  return members.size() > 1 && (score > 0 || fall > rules::by_chance(numbers, beginnings));
}

/// The members in one model, and how they came into it.
struct Together {
  std::vector<const TriedEffect*> members;
  std::vector<CandidateModel> so_far;  ///< with each member and those before it
  TriedEffect all;                     ///< the last one's candidate, with the others before it
};

Together fitted_together(const SearchState& state, const FitContext& context,
                         const std::vector<const TriedEffect*>& members) {
  Together set{members, {members.front()->candidate}, *members.back()};
  for (std::size_t k = 1; k < members.size() && set.so_far.back().ok; ++k) {
    const TriedEffect& m = *members[k];
    state.progress(fmt::format("{} on {} outputs at once", m.effect->id, k + 1), 0.9);
    set.so_far.push_back(
        with_effect(context, set.so_far.back(), *m.effect, m.laws[m.law], m.place, m.excitation, Effort::full));
    const auto& before = members[k - 1]->outputs;
    set.all.outputs.insert(set.all.outputs.end(), before.begin(), before.end());
  }
  set.all.laws_tried.clear();  // they competed where the last one stood alone
  set.all.candidate = set.so_far.back();
  return set;
}

std::vector<Together> sets_of(const SearchState& state, const std::vector<TriedEffect>& first) {
  const auto order = ranking(first);
  std::vector<std::vector<const TriedEffect*>> worth;
  std::vector<const Effect*> seen;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const TriedEffect& t = first[order[i]];
    if (!agrees(t) || std::find(seen.begin(), seen.end(), t.effect) != seen.end()) continue;
    seen.push_back(t.effect);
    if (auto members = of_one_effect(first, order, i); could_suffice(state, members)) worth.push_back(members);
  }
  std::vector<Together> sets(worth.size());
  state.side_by_side(worth.size(), [&](std::size_t i, const FitContext& context) {
    sets[i] = fitted_together(state, context, worth[i]);
    return false;
  });
  return sets;
}

/// The members of the set that is claimed but the last, each as a step of its own.
void tell_those_before(SearchState& state, int step, const Together& set) {
  for (std::size_t k = 0; k + 1 < set.members.size(); ++k) {
    std::vector<TriedEffect> one{*set.members[k]};
    one[0].candidate = set.so_far[k];
    one[0].laws_tried.clear();
    take(state, step + static_cast<int>(k), one[0], {});
    one[0].reason += "; claimed with that of the other outputs";
    keep_candidates(state, one, step + static_cast<int>(k), 0, {});
  }
}

}  // namespace

bool on_axes_together(SearchState& state, const std::vector<TriedEffect>& first) {
  if (state.stopped() || state.base_model->outputs().size() < 2 ||
      state.current.error_of.over_floor() > rules::floor_gate)
    return false;
  const auto sets = sets_of(state, first);
  if (sets.empty()) return false;
  std::vector<TriedEffect> tried;
  for (const auto& set : sets) tried.push_back(set.all);
  compare_all(state, tried, As::first);
  int winner = best_admitted(tried);
  while (winner >= 0 && !stays_itself(state, tried[static_cast<std::size_t>(winner)])) winner = best_admitted(tried);
  std::vector<int> ties;
  int step = static_cast<int>(state.d.steps.size()) + 1;
  if (winner >= 0) {
    const auto& set = sets[static_cast<std::size_t>(winner)];
    ties = ties_of(state, tried, static_cast<std::size_t>(winner));
    tell_those_before(state, step, set);
    step = static_cast<int>(state.d.steps.size()) + 1;
    claim(state, step, tried, static_cast<std::size_t>(winner), ties, 0.95);
  }
  keep_candidates(state, tried, step, winner, ties);
  return winner >= 0;
}

}  // namespace hysteron
