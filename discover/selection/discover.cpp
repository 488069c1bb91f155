#include "discover/selection/discover.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "discover/search/between_samples.h"
#include "discover/search/ties.h"
#include "discover/selection/first_part.h"
#include "discover/selection/kept_table.h"
#include "discover/selection/limits.h"
#include "discover/selection/selection.h"
#include "discover/selection/structure_term.h"
#include "discover/selection/told.h"
#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"

namespace hysteron {
namespace {

/// A number found within this part of what it is known to is as the user wrote it, however sure the difference is.
constexpr double as_written = 0.1;

struct Asked {
  const Diagram& diagram;
  const Registry& registry;
  const Effects& effects;
  const DiscoverOptions& options;
};

/// Recordings with a model of them. Stays where it is: what was found refers to it.
struct Search {
  /// `facts`: where recordings begin and how inputs move between their samples, as far as that was found (as_found).
  Search(const Asked& asked, const DataSet& data, const Discovery& facts)
      : state(asked.diagram, as_found(data, facts), asked.registry, asked.effects, asked.options) {
    state.d.asked_for = asked.options.only;
    state.d.found_starts = facts.found_starts;
    state.d.smooth_inputs = facts.smooth_inputs;
    fit_base(state);
  }

  SearchState state;
  // Seen on the way, and all begins anew with it:
  std::optional<SmoothInput> smooth{};  ///< an input that moves smoothly
  std::vector<std::string> moving{};    ///< recordings that do not begin at rest
  bool begins_anew() const { return smooth || !moving.empty(); }
  std::optional<Selection> selection{};  ///< where effects were searched in these recordings
};

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
    if ((has_spare || effect.straight) && is_the_winner_and_more(state, r.tried, effect)) continue;
    if (!why_not_itself(r.fitted).empty()) continue;
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

/// Share of what stands above the noise on validation recordings of these outputs (all if empty) that a model removes.
double share_of(const ModelError& was, const ModelError& is, const std::vector<std::string>& outputs) {
  double before = 0, after = 0;
  for (std::size_t i = 0; i < was.recordings.size() && i < is.recordings.size(); ++i) {
    const auto& r = was.recordings[i];
    const bool counts = outputs.empty() || std::find(outputs.begin(), outputs.end(), r.output) != outputs.end();
    if (r.role != Role::validate || !counts) continue;
    before += r.excess();
    after += is.recordings[i].excess();
  }
  return before > 0 ? 1 - after / before : 0;
}

void tell_step(SearchState& state, Search& searched, const Told& told, std::size_t k) {
  Selection& selection = *searched.selection;
  const bool elsewhere = &state != &searched.state;
  FoundStep found;
  const auto& term = told.terms[k];
  const CandidateModel& whole = told.chain.back();
  TriedEffect w = tried_as(selection, whole.placed[term.front()]);
  const ModelError before = state.evidence->error(told.chain[k].prediction);
  w.candidate = told.chain[k + 1];
  w.candidate.error_of = state.evidence->error(w.candidate.prediction);
  w.fall_train = before.evidence_train - w.candidate.error_of.evidence_train;
  w.fall_validate = before.evidence_validate - w.candidate.error_of.evidence_validate;
  w.share = std::clamp(share_of(before, w.candidate.error_of, {}), 0.0, 1.0);
  w.fall_by_recording = fall_by_recording(before, w.candidate.error_of);
  w.reason = what_it_takes(w, judged_on(state.d));
  const bool alone = told.chain.size() == 2;
  const int step = static_cast<int>(k) + 1;
  unless_it_fails(state, [&] {
    const Effect& effect = *whole.placed[term.front()].effect;
    auto rivals = alone ? selection.rounds().front().rivals : selection.in_place_of(term);
    if (alone)
      for (auto& hidden : selection.hidden_in_place_of(effect)) rivals.push_back(std::move(hidden));
    // Where others stand, too, it is compared as the last of them, as its rivals are; in the recordings of these.
    TriedEffect last = w;
    TableModel winner = selection.best();
    if (elsewhere) last.candidate = winner.model;
    if (!alone && !rivals.empty() && rivals.front().tried.effect == &effect && rivals.front().fitted.ok()) {
      winner = rivals.front().fitted;
      last = rivals.front().tried;
      last.candidate = winner.model;
    }
    for (const auto& r : tied(searched.state, selection, winner, effect, rivals)) {
      TriedEffect rival = r.tried;
      rival.candidate = r.fitted.model;
      rival.candidate.error_of = searched.state.evidence->error(rival.candidate.prediction);
      rival.reason = "explains the recordings as well as the one that was taken";
      add_tie(searched.state, step, found, last, rival);
    }
  });
  found.before = before;
  found.after = w.candidate.error_of;
  found.winner = candidate_of(w, step);
  found.winner.claimed = true;
  for (std::size_t i = 1; i < term.size(); ++i) found.winner.also_at.push_back(whole.placed[term[i]].place.where());
  found.change = w.candidate.change;
  found.change.diagram = w.candidate.diagram;
  const PlacedEffect& standing = whole.placed[term.front()];  // whatever was added last on the way
  found.change.name = standing.name;
  found.change.effect = standing.effect->id;
  found.change.at = standing.place.at;
  found.change.law = standing.law.name;
  state.d.steps.push_back(std::move(found));
}

/// What a model takes away of what `before` leaves.
struct Fall {
  double train = 0, validate = 0;
  std::vector<double> by_recording;
};
Fall fall_of(const Selection& selection, const Evidence& evidence, const TableModel& before, const TableModel& f) {
  Fall fall;
  const auto was = selection.score().chi2_of(before.left_at_last()), is = selection.score().chi2_of(f.left_at_last());
  for (std::size_t k = 0; k < was.size(); ++k) {
    fall.by_recording.push_back(was[k] - is[k]);
    const bool train = evidence.model().recording(f.left[k].recording).role == Role::train;
    (train ? fall.train : fall.validate) += was[k] - is[k];
  }
  return fall;
}

/// All laws by which a candidate was fitted.
std::vector<TriedLaw> laws_of(const Selection& selection, const Evidence& evidence, const TableModel& before,
                              const Addition& rival) {
  std::vector<TriedLaw> laws;
  for (const auto& [law, f] : rival.by_law) {
    TriedLaw tried;
    tried.law = rival.tried.laws[law].name;
    tried.failed = !f.ok();
    tried.taken = f.ok() && law == rival.tried.law;
    if (f.ok()) {
      Fall fall = fall_of(selection, evidence, before, f);
      tried.parameters = f.parameters;
      tried.fall_train = fall.train;
      tried.fall_validate = fall.validate;
      tried.fall_by_recording = std::move(fall.by_recording);
      tried.score = selection.score_of(f) - selection.score_of(before);
      const double less = selection.score_of(rival.fitted) - selection.score_of(f);
      if (!tried.taken)
        tried.reason =
            less > 0 ? fmt::format("its score is {:.1f} below that of {}", less, rival.tried.laws[rival.tried.law].name)
                     : why_not_itself(f);
    } else {
      tried.reason = "could not be fitted: " + f.model.error;
    }
    laws.push_back(std::move(tried));
  }
  return laws;
}

void tell_candidates(SearchState& state, const Search& searched, const Told& told) {
  const Selection& selection = *searched.selection;
  const Evidence& evidence = *searched.state.evidence;
  int step = 0;
  for (const auto& round : selection.rounds()) {
    ++step;
    const TableModel& before = step == 1 ? selection.nulls().better(selection.score()) : round.on;
    const ModelError was = evidence.error(before.model.prediction);
    for (const auto& r : round.rivals) {
      TriedEffect t = r.tried;
      t.candidate = r.fitted.model;
      if (t.candidate.ok) {
        t.candidate.error_of = evidence.error(t.candidate.prediction);
        const Fall fall = fall_of(selection, evidence, before, r.fitted);
        t.share = share_of(was, t.candidate.error_of, t.outputs);
        t.fall_train = fall.train;
        t.fall_validate = fall.validate;
        t.score = selection.score_of(r.fitted) - selection.score_of(before);
        t.reason = why_not_itself(r.fitted);
        if (t.reason.empty()) t.reason = how_much_more(selection, r.fitted, before);
        if (const auto gone = told.gone.find({t.effect, t.place.where()}); gone != told.gone.end())
          t.reason = "fitted to its end it is not itself: " + gone->second;
      } else {
        t.reason = "could not be fitted: " + r.fitted.model.error;
      }
      t.laws_tried = laws_of(selection, evidence, before, r);
      Candidate c = candidate_of(t, step);
      for (const auto& s : told.chain.back().placed)
        c.claimed = c.claimed || (s.effect->id == c.effect && s.place.where() == c.place);
      state.d.candidates.push_back(std::move(c));
    }
  }
}

void tell_numbers(SearchState& state, const FitSetting& setting, const Told& told) {
  const FitResult& fit = told.chain.back().fit;
  for (const auto& e : fit.estimates)
    if (const auto n = told.kept.find(e.path);
        n != told.kept.end() && std::abs(e.used / n->second - 1) > as_written * setting.known_to(e.path))
      state.d.other_numbers.push_back({e.path, e.unit, e.difference, n->second, e.used, sigma_by_witnesses(e)});
  std::stable_sort(state.d.other_numbers.begin(), state.d.other_numbers.end(), [](const auto& a, const auto& b) {
    return std::abs(a.found / a.written - 1) > std::abs(b.found / b.written - 1);
  });
}

void tell_fitted_to_all(SearchState& state, const Told& told) {
  state.d.fitted_to_all = told.fitted_to_all;
  if (!told.fitted_to_all) return;
  const auto of_role = [&](Role role) {
    std::vector<std::string> names;
    for (const auto& r : state.data->recordings)
      if (r.role == role) names.push_back(r.name);
    return fmt::format("{}", fmt::join(names, ", "));
  };
  state.d.warnings.push_back(fmt::format(
      "the numbers of what was found were fitted to {0} too, for the rows of {1} (role \"train\") do not determine "
      "them, and no other recording judges them. Record more that moves like {0}, and give it the role \"train\"",
      of_role(Role::validate), of_role(Role::train)));
}

std::string verb_of(const std::vector<std::string>& recordings) { return recordings.size() == 1 ? "does" : "do"; }

void tell_unused_starts(SearchState& state, const std::vector<std::string>& moving) {
  state.d.warnings.push_back(
      fmt::format("{} {} not begin at rest, it seems. The search that takes it into account was broken off: write "
                  "\"initial\": \"per_recording\" there in the data set and begin with that",
                  fmt::join(moving, ", "), verb_of(moving)));
}

void tell_starts(SearchState& state) {
  const auto& moving = state.d.found_starts;
  if (moving.empty()) return;
  state.d.warnings.push_back(
      fmt::format("{} {} not begin at rest: where {} was found with everything else. Say so in the data set: "
                  "\"initial\": \"per_recording\"",
                  fmt::join(moving, ", "), verb_of(moving), moving.size() == 1 ? "it begins" : "they begin"));
}

/// An input that moves smoothly where more than noise is left by this model, which is fitted so.
std::optional<SmoothInput> smooth_input_of(SearchState& state, const CandidateModel& model, const FitContext& fits) {
  std::optional<SmoothInput> smooth;
  if (!model.ok) return smooth;
  state.current = model;
  state.settle(state.current);
  if (state.current.error_of.over_floor() > rules::floor_gate)
    state.unless_stopped([&] { smooth = find_smooth_input(state, fits); });
  return smooth;
}

/// What was found stays found where the search for more fails: a model that was fitted may be one that cannot be
/// simulated with another effect.
void select(Search& search) {
  const auto is_over = [&](const TableModel& best) {
    const FitSetting& setting = search.selection->setting();
    search.smooth = smooth_input_of(
        search.state, best.model, context_for(setting, search.state.context, weights_of(setting, best), best.numbers));
    return search.smooth.has_value();
  };
  try {
    search.state.unless_stopped([&] { search.selection->run(is_over); });
  } catch (const Error& e) {
    if (search.selection->rounds().empty()) throw;
    search.state.d.warnings.push_back(fmt::format("the search for further effects ended early: {}", e.what()));
  }
}

/// Beside all that was found: beside a part of it what is still missing would pass for a start. And in the place of
/// each term: nobody has to believe in an effect that a start can be.
void look_at_starts(Search& search) {
  Selection& selection = *search.selection;
  if (search.smooth || selection.best().model.placed.empty()) return;
  const FitSetting& setting = selection.setting();
  search.state.unless_stopped([&] {
    search.moving = begin_in_motion_beside(setting, selection.best(), selection.best(), rules::by_score);
    for (const auto& term : terms_of(selection.best().model)) {
      if (!search.moving.empty()) break;
      if (const TableModel rest = selection.rest_without(term); rest.ok())
        search.moving = begin_in_motion_beside(setting, rest, selection.best(), -rules::tie);
    }
  });
}

/// The recordings with these facts, and what was found in them. How an input moves may show in what the user's model
/// leaves, or behind a strong effect once that is known.
std::unique_ptr<Search> search_with(const Asked& asked, const DataSet& data, const Discovery& facts) {
  auto search = std::make_unique<Search>(asked, data, facts);
  search->selection.emplace(search->state, numbers_not_exact(search->state));
  search->smooth = smooth_input_of(search->state, search->state.base, search->state.context);
  if (!search->smooth) {
    select(*search);
    look_at_starts(*search);
  }
  return search;
}

/// In the order of the recordings, each once.
void add_starts(std::vector<std::string>& known, const std::vector<std::string>& more, const DataSet& data) {
  const auto all = std::exchange(known, {});
  const auto is_in = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const auto& r : data.recordings)  // one that is cut in time stands there twice
    if ((is_in(all, r.name) || is_in(more, r.name)) && !is_in(known, r.name)) known.push_back(r.name);
}

std::unique_ptr<Search> search_in(const Asked& asked, const DataSet& data) {
  Discovery facts;
  facts.found_starts = begin_in_motion(asked.diagram, data, asked.registry, asked.effects, asked.options);
  auto search = search_with(asked, data, facts);
  while (search->begins_anew() && !search->state.stopped()) {
    search->state.progress(search->smooth ? "anew: " + search->smooth->input + " moves smoothly between its samples"
                                          : fmt::format("anew: not at rest begin {}", fmt::join(search->moving, ", ")),
                           0);
    if (search->smooth) facts.smooth_inputs.push_back(*search->smooth);
    add_starts(facts.found_starts, search->moving, data);
    auto again = search_with(asked, data, facts);
    const auto names = [](const Search& s) { return terms_of(s.selection->best().model).size(); };
    // Broken off before it had found again what was found without: that is still true.
    if (again->state.stopped() && names(*again) < names(*search)) break;
    search = std::move(again);
  }
  if (search->smooth) tell_unused(search->state, *search->smooth);
  if (!search->moving.empty()) tell_unused_starts(search->state, search->moving);
  search->state.d.broken_off = search->state.stopped() || search->selection->left_some_out();
  search->state.closing = true;  // what was found is told in full
  return search;
}

std::string parts_of(const DataSet& part) {
  std::vector<std::string> list;
  for (const auto& r : part.recordings)
    if (r.role != Role::test) list.push_back(fmt::format("{} rows of {}", r.last - r.first, r.name));
  return fmt::format("{}", fmt::join(list, ", "));
}

/// Whether inputs are held between their samples, in the recordings that were searched in.
void tell_ways_between(SearchState& state, Search& searched) {
  SearchState& part = searched.state;
  const std::size_t before = part.d.warnings.size();
  part.unless_stopped([&] { tell_other_ways(part); });
  if (&part == &state) return;
  const auto first = part.d.warnings.begin() + static_cast<std::ptrdiff_t>(before);
  state.d.warnings.insert(state.d.warnings.end(), first, part.d.warnings.end());
}

/// `elsewhere`: the state that judges what was found, where that is not the one that was searched in.
Discovery tell(std::unique_ptr<Search> searched, std::unique_ptr<Search> elsewhere, std::optional<Told> told) {
  SearchState& state = elsewhere ? elsewhere->state : searched->state;
  if (told) {
    tell_fitted_to_all(state, *told);
    state.base = told->chain.front();
    state.current = told->chain.back();
    state.settle(state.current);
    if (elsewhere) searched->state.settle(searched->state.current = searched->selection->best().model);
    for (std::size_t k = 0; k + 1 < told->chain.size(); ++k) tell_step(state, *searched, *told, k);
    state.current = told->chain.back();
    state.settle(state.current);
    state.d.base_diagram = state.base.diagram;
    tell_candidates(state, *searched, *told);
    tell_numbers(state, searched->selection->setting(), *told);
  }
  if (!state.d.steps.empty())
    state.unless_stopped([&] { state.structure = structure_beside_effects(searched->state, *searched->selection); });
  tell_ways_between(state, *searched);
  if (!state.stopped() && (!state.structure || !state.structure->judged.requirement.passed()))
    tell_limits(searched->state, *searched->selection, state.d);
  tell_starts(state);
  if (state.options.keeps_table) state.d.table = table_of(searched->state, *searched->selection);
  state.d.model_runs = searched->state.context.derivatives->runs();
  if (elsewhere) {  // long recordings: what is not needed any more goes
    state.d.model_runs += state.context.derivatives->runs();
    told.reset();
    searched.reset();
  }
  conclude(state);
  return std::move(state.d);
}

}  // namespace

Discovery discover(const Diagram& diagram, const DataSet& data, const Registry& registry, const Effects& effects,
                   const DiscoverOptions& options) {
  const Asked asked{diagram, registry, effects, options};
  const auto part = first_part(data);
  auto searched = search_in(asked, part ? *part : data);
  if (part && searched->selection->best().ok()) {
    const StopScope to_its_end(nullptr);
    auto all = std::make_unique<Search>(asked, data, searched->state.d);
    all->state.d.broken_off = searched->state.d.broken_off;
    all->state.closing = true;
    Told told = to_be_told(all->state, searched->state, *searched->selection);
    if (holds(all->state, *searched->selection, told)) {
      all->state.d.warnings.push_back(
          fmt::format("Effects were searched for in the first {}: what was found is fitted to all rows and leaves no "
                      "more in them.",
                      parts_of(*part)));
      return tell(std::move(searched), std::move(all), std::move(told));
    }
    all.reset();
    searched = search_in(asked, data);
    searched->state.d.warnings.push_back(
        fmt::format("The first {} do not show all that acts: effects were searched for in all rows.", parts_of(*part)));
  }
  const StopScope to_its_end(nullptr);  // whoever stops the search is told what it had found
  std::optional<Told> told;
  if (searched->selection->best().ok()) told = to_be_told(searched->state, searched->state, *searched->selection);
  return tell(std::move(searched), nullptr, std::move(told));
}

Discovery diagnose(const Diagram& diagram, const DataSet& data, const Registry& registry, const Effects& effects,
                   DiscoverOptions options) {
  options.max_steps = 1;
  return discover(diagram, data, registry, effects, options);
}

}  // namespace hysteron
