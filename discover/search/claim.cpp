// Decides what a claim says: the best candidate of a step with its intervals, its ties, and the experiment that would
// break them.
#include <fmt/format.h>

#include "discover/search/search_state.h"
#include "discover/search/tie_experiment.h"

namespace hysteron {
namespace {

/// Some effects show their worth only beside those that come after them.
std::string as_one_of_a_set(const TriedEffect& w) {
  return fmt::format(
      "one of a set: before the others it adds {:.0f} to chi2 on recordings not used for the fit, beside them it is "
      "needed",
      -w.fall_validate);
}

/// The reason is told in the units of the noise as settled by the claimed model.
void judge_again(const Evidence& evidence, TriedEffect& w, const ModelError& before) {
  CandidateModel was;
  was.ok = true;
  was.error_of = before;
  was.parameters = 0;
  const bool admitted = w.admitted;
  judge(evidence, w, was, {});
  if (admitted && !w.admitted) w.reason = w.fall_validate > 0 ? what_it_takes(w) : as_one_of_a_set(w);
  w.admitted = admitted;
}

}  // namespace

void add_tie(SearchState& state, int step, FoundStep& found, const TriedEffect& winner, const TriedEffect& rival) {
  found.ties.push_back(candidate_of(rival, step));
  if (state.stopped()) return;
  auto [e, menu] =
      found.experiment ? with_another_rival(state, *found.experiment, rival) : experiment_between(state, winner, rival);
  if (e || !found.experiment) found.menu = std::move(menu);
  if (!e) return;
  found.experiment_would_tell = e->rivals_told > 0;
  found.experiment = std::move(e);
}

bool stays_itself(const SearchState& state, TriedEffect& t) {
  if (t.sharp || t.finished) return t.admitted;
  CandidateModel final = state.stopped() ? CandidateModel{} : refit(state.context, t.candidate, Effort::final);
  // Of two that explain as well the one with finer rows, which knows its intervals.
  const bool as_good = final.ok && final.error_of.evidence() <= t.candidate.error_of.evidence() + rules::tie;
  t.finished = as_good ? std::move(final) : t.candidate;
  const auto why = why_implausible(*t.effect, t.laws[t.law], *t.finished, t.excitation);
  if (why.empty()) return true;
  t.admitted = false;
  t.reason = "fitted to its end: " + why;
  return false;
}

void claim(SearchState& state, int step, std::vector<TriedEffect>& tried, std::size_t winner,
           const std::vector<int>& ties, double progress) {
  TriedEffect& w = tried[winner];
  state.progress("intervals of " + w.effect->id, progress);
  FoundStep found;
  found.before = state.current.error_of;
  stays_itself(state, w);
  if (w.finished) w.candidate = *w.finished;
  for (const int t : ties) add_tie(state, step, found, w, tried[static_cast<std::size_t>(t)]);
  take(state, step, w, std::move(found));
}

void take(SearchState& state, int step, TriedEffect& w, FoundStep found) {
  state.current = w.candidate;
  state.settle(state.current);
  found.before =
      state.evidence->error(state.before_prediction.y.empty() ? state.base.prediction : state.before_prediction);
  state.before_prediction = state.current.prediction;
  w.candidate.error_of = state.current.error_of;
  judge_again(*state.evidence, w, found.before);
  found.after = state.current.error_of;
  found.winner = candidate_of(w, step);
  found.winner.claimed = true;
  found.change = state.current.change;
  found.change.diagram = state.current.diagram;
  state.d.steps.push_back(std::move(found));
}

}  // namespace hysteron
