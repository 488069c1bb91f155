// Decides whether a discovery begins with another effect, or goes on with two at once: greedy search takes the one that
// explains most alone, and the pair that explains everything need not hold it; nor need either of the pair be more than
// a patch without the other.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "discover/search/search_state.h"

namespace hysteron {
namespace {

constexpr int most_beginnings = 3;  // names that are tried in its place
constexpr int patches = 2;          // on which another one is tried: what takes least seldom holds one of the pair

/// The best admitted effect on top of the present model, fitted together with it. `begun` is none: beside that one the
/// present effect was refused.
std::optional<TriedEffect> with_one_more(SearchState& state, const std::string& begun) {
  auto tried = list_candidates(state, 2);
  fit_candidates(state, tried, 2);
  join_twins(tried);
  std::erase_if(tried, [&](const TriedEffect& t) { return t.effect->id == begun; });
  compare_all(state, tried, As::further);
  refit_best(state, tried, As::further, 0.9);
  enrich(state, tried, 2, As::further, 0.9);
  const int best = best_admitted(tried);
  if (best < 0) return std::nullopt;
  return std::move(tried[static_cast<std::size_t>(best)]);
}

/// Is `first` no patch beside the other one, as that one is none beside it?
bool needs_both(SearchState& state, const TriedEffect& first, const TriedEffect& second,
                const std::vector<TriedEffect>& alone) {
  const auto other = std::find_if(alone.begin(), alone.end(), [&](const TriedEffect& t) {
    return t.effect == second.effect && t.place.where() == second.place.where() && t.candidate.ok;
  });
  if (other == alone.end()) return false;
  CandidateModel without = other->candidate;
  without.error_of = state.evidence->error(without.prediction);
  TriedEffect t = first;
  t.candidate = second.candidate;
  t.candidate.error_of = state.evidence->error(t.candidate.prediction);
  judge(*state.evidence, t, without, left_by_laws_of(state, without));
  return t.admitted;
}

/// Two effects in the place of one explain most of what that one leaves: its law need not be more than nearly right.
bool is_worth_two(const CandidateModel& pair, const CandidateModel& stands) {
  return pair.placed.size() <= stands.placed.size() ||
         pair.error_of.excess_validate() < 0.5 * stands.error_of.excess_validate();
}

/// On top of a patch nobody else was: the pair is told only if nothing but noise is left.
bool leaves_only_noise(const SearchState& state, const CandidateModel& c) {
  return state.evidence->over_usual_floor(c.prediction).all <= rules::floor_gate;
}

}  // namespace

bool another_beginning(SearchState& state, const std::vector<TriedEffect>& first) {
  if (state.stopped() || state.options.max_steps < 2) return false;
  if (state.evidence->over_usual_floor(state.current.prediction).all <= rules::floor_gate) return false;
  const CandidateModel stands = state.current;
  const std::string begun = state.d.steps.empty() ? "" : state.d.steps.front().winner.effect;
  std::optional<CandidateModel> best;
  int tried = 0;
  for (const std::size_t i : ranking(first)) {
    if (tried == most_beginnings || state.stopped()) break;
    const TriedEffect& t = first[i];
    if (!(begun.empty() ? t.patch : t.admitted) || t.effect->id == begun) continue;
    ++tried;
    state.progress("beginning with " + t.effect->id, 0.9);
    state.current = t.candidate;
    state.settle(state.current);
    const auto pair = with_one_more(state, begun);
    if (!pair || (begun.empty() && !needs_both(state, t, *pair, first))) continue;
    if (!best || pair->candidate.error_of.rms_validate < best->error_of.rms_validate) best = pair->candidate;
  }
  state.current = stands;
  if (!best) return false;
  state.settle(*best);
  state.current.error_of = state.evidence->error(state.current.prediction);
  if (best->score() < state.current.score() - rules::exchange &&
      (begun.empty() || is_worth_two(*best, state.current)) && tell_again(state, *best)) {
    reconsider(state, 0.95, Came::at_once);
    return true;
  }
  state.settle(state.current);
  return false;
}

bool no_patch_of_anything(SearchState& state, const std::vector<TriedEffect>& first) {
  if (state.stopped() || !state.d.steps.empty()) return false;
  const auto order = ranking(first);
  const auto patch = std::find_if(order.begin(), order.end(), [&](std::size_t i) { return first[i].patch; });
  if (patch == order.end() || leaves_something_unexplained(state)) return false;
  if (!tell_again(state, first[*patch].candidate)) return false;
  reconsider(state, 0.95, Came::at_once);
  return true;
}

bool two_more(SearchState& state, const std::vector<TriedEffect>& last) {
  if (state.stopped() || found_effects(state) + 2 > state.options.max_steps) return false;
  if (leaves_only_noise(state, state.current)) return false;
  const CandidateModel stands = state.current;
  std::optional<CandidateModel> best;
  int tried = 0;
  for (const std::size_t i : ranking(last)) {
    if (tried == patches || state.stopped()) break;
    const TriedEffect& t = last[i];
    if (!t.patch) continue;
    ++tried;
    state.progress("two at once: " + t.effect->id, 0.9);
    state.current = refit(state.context, t.candidate, Effort::full);
    if (!state.current.ok) continue;
    state.settle(state.current);
    const auto pair = with_one_more(state, "");  // the same, in another block, too
    state.settle(state.current);
    if (!pair || !leaves_only_noise(state, pair->candidate) || !needs_both(state, t, *pair, last)) continue;
    if (!best || pair->candidate.score() < best->score()) best = pair->candidate;
  }
  state.current = stands;
  state.settle(state.current);
  if (!best || !tell_again(state, *best)) return false;
  reconsider(state, 0.95, Came::at_once);
  return true;
}

}  // namespace hysteron
