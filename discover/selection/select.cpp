#include "discover/selection/select.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "discover/selection/selection.h"
#include "engine/diagram/stop.h"

namespace hysteron {
namespace {

/// A number found within this part of what it is known to is as the user wrote it, however sure the difference is.
constexpr double as_written = 0.1;

/// The model that is told: with the fewest of the user's numbers let go, with intervals, and what it is without its
/// last terms.
struct Told {
  std::map<std::string, double> kept;  ///< numbers that are not what is written, as written [SI]
  FitContext context;
  std::vector<CandidateModel> chain;            ///< [k]: with the first k terms; the last is the whole model
  std::vector<std::vector<std::size_t>> terms;  ///< of the whole model
};

Told to_be_told(SearchState& state, const Selection& selection) {
  Told told;
  const FitSetting& setting = selection.setting();
  TableModel best = selection.best();
  if (best.numbers == Numbers::let_go)
    state.unless_stopped(
        [&] { best = with_fewest_numbers(setting, state.context, selection.score(), best, told.kept); });
  const FitSetting few = setting.with(told.kept);
  told.context =
      context_for(few, state.context, weights_of(few, best), told.kept.empty() ? Numbers::written : Numbers::let_go);
  told.context.data = state.data;  // others judge
  const auto of_all = std::exchange(told.context.derivatives, std::make_shared<DerivativeStore>());
  CandidateModel whole = best.model;
  state.unless_stopped([&] {
    CandidateModel final = refit(told.context, whole, Effort::final);
    if (final.ok) whole = std::move(final);
  });
  told.terms = terms_of(whole);
  told.chain.assign(told.terms.size() + 1, whole);
  for (std::size_t k = told.terms.size(); k-- > 0;) {
    CandidateModel before = told.chain[k + 1];
    // Terms before this one leave later: its own effects stand where they stand in the whole model, less those gone.
    for (std::size_t i = before.placed.size(); i-- > 0 && before.ok;)
      if (before.placed[i].effect == whole.placed[told.terms[k].front()].effect)
        before = without(told.context, before, i);
    told.chain[k] = before.ok ? refit(told.context, before, Effort::full) : before;
    if (!told.chain[k].ok) told.chain[k] = k == 0 ? state.base : told.chain[k + 1];
  }
  of_all->count(told.context.derivatives->runs());
  return told;
}

/// Of the candidates of all rounds the one that stands as this term.
TriedEffect tried_as(const Selection& selection, const PlacedEffect& s) {
  for (auto round = selection.rounds().rbegin(); round != selection.rounds().rend(); ++round)
    for (const auto& r : round->rivals)
      if (r.tried.effect == s.effect && r.tried.place.where() == s.place.where()) {
        TriedEffect t = r.tried;
        for (std::size_t l = 0; l < t.laws.size(); ++l)
          if (t.laws[l].name == s.law.name) t.law = l;
        return t;
      }
  TriedEffect t;
  t.effect = s.effect;
  t.place = s.place;
  t.laws = {s.law};
  return t;
}

/// Rivals that explain as much as the winner by other effects, each effect once.
std::vector<Addition> tied(const SearchState& state, const Selection& selection, const TableModel& winner,
                           const Effect& effect, std::vector<Addition> rivals) {
  std::vector<Addition> list;
  const double reach = tie_score_of(selection.score(), winner) - rules::tie;
  for (auto& r : rivals) {
    if (!r.fitted.ok() || r.tried.effect == &effect || tie_score_of(selection.score(), r.fitted) < reach) continue;
    // What a law says with one number more it does not say by what it could be bent to.
    const bool has_spare = r.fitted.parameters > winner.parameters + 1;
    if (has_spare && is_the_winner_and_more(state, r.tried, effect)) continue;
    if (!why_implausible(*r.tried.effect, r.tried.laws[r.tried.law], r.fitted.model, r.tried.excitation).empty())
      continue;
    if (std::any_of(list.begin(), list.end(), [&](const Addition& a) { return a.tried.effect == r.tried.effect; }))
      continue;
    list.push_back(std::move(r));
  }
  return list;
}

std::string how_much_more(const Selection& selection, const TableModel& f, const TableModel& before) {
  const double more = selection.score_of(f) - selection.score_of(before);
  return fmt::format("its score is {:.1f} {} that of the model without it; {:.0f} more are asked", std::abs(more),
                     more < 0 ? "below" : "above", rules::by_score);
}

void tell_step(SearchState& state, Selection& selection, const Told& told, std::size_t k) {
  FoundStep found;
  const auto& term = told.terms[k];
  const CandidateModel& whole = told.chain.back();
  TriedEffect w = tried_as(selection, whole.placed[term.front()]);
  const ModelError before = state.evidence->error(told.chain[k].prediction);
  w.candidate = told.chain[k + 1];
  w.candidate.error_of = state.evidence->error(w.candidate.prediction);
  w.fall_train = before.evidence_train - w.candidate.error_of.evidence_train;
  w.fall_validate = before.evidence_validate - w.candidate.error_of.evidence_validate;
  const double excess = before.excess_validate();
  w.share = excess > 0 ? std::clamp(1 - w.candidate.error_of.excess_validate() / excess, 0.0, 1.0) : 0;
  w.fall_by_recording = fall_by_recording(before, w.candidate.error_of);
  w.admitted = true;
  w.reason = what_it_takes(w);
  const bool alone = told.chain.size() == 2;
  const int step = static_cast<int>(k) + 1;
  unless_it_fails(state, [&] {
    const Effect& effect = *whole.placed[term.front()].effect;
    auto rivals = alone ? selection.rounds().front().rivals : selection.in_place_of(term);
    if (alone)
      for (auto& hidden : selection.hidden_in_place_of(effect)) rivals.push_back(std::move(hidden));
    // Where others stand, too, it is compared as the last of them, as its rivals are.
    TriedEffect last = w;
    TableModel winner = selection.best();
    if (!alone && !rivals.empty() && rivals.front().tried.effect == &effect && rivals.front().fitted.ok()) {
      winner = rivals.front().fitted;
      last = rivals.front().tried;
      last.candidate = winner.model;
    }
    for (const auto& r : tied(state, selection, winner, effect, rivals)) {
      TriedEffect rival = r.tried;
      rival.candidate = r.fitted.model;
      rival.candidate.error_of = state.evidence->error(rival.candidate.prediction);
      rival.admitted = true;
      rival.reason = "explains the recordings as well as the one that was taken";
      add_tie(state, step, found, last, rival);
    }
    return true;
  });
  found.before = before;
  found.after = w.candidate.error_of;
  found.winner = candidate_of(w, step);
  found.winner.claimed = true;
  for (std::size_t i = 1; i < term.size(); ++i) found.winner.also_at.push_back(whole.placed[term[i]].place.where());
  found.change = w.candidate.change;
  found.change.diagram = w.candidate.diagram;
  state.d.steps.push_back(std::move(found));
}

void tell_candidates(SearchState& state, const Selection& selection, const Told& told) {
  int step = 0;
  for (const auto& round : selection.rounds()) {
    ++step;
    const TableModel& before = step == 1 ? selection.nulls().better(selection.score()) : round.on;
    for (const auto& r : round.rivals) {
      TriedEffect t = r.tried;
      t.candidate = r.fitted.model;
      if (t.candidate.ok) t.candidate.error_of = state.evidence->error(t.candidate.prediction);
      t.reason =
          !r.fitted.ok() ? "could not be fitted: " + r.fitted.model.error : how_much_more(selection, r.fitted, before);
      Candidate c = candidate_of(t, step);
      for (const auto& s : told.chain.back().placed)
        c.claimed = c.claimed || (s.effect->id == c.effect && s.place.where() == c.place);
      state.d.candidates.push_back(std::move(c));
    }
  }
}

void tell_numbers(SearchState& state, const Told& told) {
  const FitResult& fit = told.chain.back().fit;
  for (const auto& e : fit.estimates)
    if (const auto n = told.kept.find(e.path);
        n != told.kept.end() && std::abs(e.used / n->second - 1) > as_written * known_to)
      state.d.other_numbers.push_back({e.path, e.unit, e.difference, n->second, e.used, sigma_by_witnesses(fit, e)});
  std::stable_sort(state.d.other_numbers.begin(), state.d.other_numbers.end(), [](const auto& a, const auto& b) {
    return std::abs(a.found / a.written - 1) > std::abs(b.found / b.written - 1);
  });
}

void tell_starts(SearchState& state, const std::vector<std::string>& moving) {
  state.d.found_starts = moving;
  if (moving.empty()) return;
  state.d.warnings.push_back(fmt::format(
      "{} {} not begin at rest: where {} was found with everything else. Say so in the data set: "
      "\"initial\": \"per_recording\"",
      fmt::join(moving, ", "), moving.size() == 1 ? "does" : "do", moving.size() == 1 ? "it begins" : "they begin"));
}

}  // namespace

Discovery select_model(const Diagram& diagram, const DataSet& data, const Registry& registry, const Effects& effects,
                       const DiscoverOptions& options) {
  const std::vector<std::string> moving = begin_in_motion(diagram, data, registry, effects, options);
  Discovery facts;
  facts.found_starts = moving;
  SearchState state(diagram, as_found(data, facts), registry, effects, options);
  state.by_score = true;
  state.d.asked_for = options.only;
  fit_base(state);
  Selection selection(state, numbers_not_exact(state));
  state.unless_stopped([&] { selection.run(); });
  state.d.broken_off = state.stopped();
  state.closing = true;  // what was found is told in full
  if (selection.best().ok()) {
    const Told told = to_be_told(state, selection);
    state.base = told.chain.front();
    state.current = told.chain.back();
    state.settle(state.current);
    for (std::size_t k = 0; k + 1 < told.chain.size(); ++k) tell_step(state, selection, told, k);
    state.current = told.chain.back();
    state.settle(state.current);
    state.d.base_diagram = state.base.diagram;
    tell_candidates(state, selection, told);
    tell_numbers(state, told);
  }
  tell_starts(state, moving);
  conclude(state);
  state.d.model_runs = state.context.derivatives->runs();
  return std::move(state.d);
}

}  // namespace hysteron
