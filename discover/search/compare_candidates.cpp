// Decides how the candidates of a step are compared: noise by the best of them, further effects together with those
// that stand, richer laws of the best names, and what the recordings cannot show as a rival.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <set>

#include "discover/search/laws_tried.h"
#include "discover/search/search_state.h"
#include "engine/diagram/stop.h"

namespace hysteron {
namespace {

double evidence_of(const CandidateModel& candidate, const std::string& output) {
  double sum = 0;
  for (const auto& r : candidate.error_of.recordings)
    if (r.output == output) sum += r.evidence;
  return sum;
}

/// What each output's best model leaves there: the noise of one axis is not known from who explains another one.
Prediction best_of_each_output(const SearchState& state, const std::vector<TriedEffect>& tried) {
  Prediction best = state.current.prediction;
  for (std::size_t o = 0; o < state.base_model->outputs().size(); ++o) {
    const std::string& output = state.base_model->outputs()[o];
    const CandidateModel* who = &state.current;
    for (const auto& t : tried)
      if (t.candidate.ok && evidence_of(t.candidate, output) < evidence_of(*who, output)) who = &t.candidate;
    if (state.base_model->outputs().size() == 1) return who->prediction;
    for (std::size_t r = 0; r < best.y.size(); ++r)
      if (!best.y[r].empty()) best.y[r][o] = who->prediction.y[r][o];
  }
  return best;
}

/// Not a line and more, but another shape of as many numbers that fits better: what laws may have left speaks for
/// neither.
bool in_place_of_a_line(const TriedEffect& t, const TriedEffect& line) {
  return t.candidate.parameters <= line.candidate.parameters &&
         line.candidate.error_of.evidence() - t.candidate.error_of.evidence() > rules::claim_fall;
}

/// A law that has a zero of its own found anew, and is neutral otherwise, is a calibration by another name; so is one
/// that is not beyond what the laws that stand may have left.
void leave_to_calibration(std::vector<TriedEffect>& tried, const std::vector<double>& left) {
  for (const auto& plain : tried) {
    if (!plain.effect->straight || !plain.candidate.ok) continue;  // also where the laws that stand may have left it
    for (auto& t : tried) {
      if (!t.admitted || !t.effect->moves_zero) continue;
      if (in_place_of_a_line(t, plain) || more_than_a_line(*t.effect, plain.candidate, t.candidate.error_of, left))
        continue;
      t.admitted = false;
      t.reason = "a gain and a zero alone take away as much";
    }
  }
}

/// What was fitted with the earlier effects held takes away less than together with them, but not by orders of
/// magnitude: what stays far below the least fall of a claim needs no fit of everything. `left`: see left_by_laws.
bool within_reach(const SearchState& state, const TriedEffect& t, const std::vector<double>& left) {
  const auto& recordings = state.current.error_of.recordings;
  double own = 0;
  for (std::size_t i = 0; i < left.size(); ++i)
    if (recordings[i].role == Role::validate) own += left[i];
  own = std::min(own, state.current.error_of.excess_validate());
  // What was taken up by the values that are held can be in the way on other recordings.
  const double fall = std::max(state.current.error_of.chi2_validate - t.candidate.error_of.chi2_validate,
                               state.current.error_of.chi2_train - t.candidate.error_of.chi2_train);
  return fall > rules::screened_part * std::max(rules::claim_fall, own);
}

/// The best few by score, and the best two on the recordings that were fitted: a law whose share the held values have
/// taken up is wrong on the others until everything is fitted.
std::set<std::size_t> worth_a_fit(const std::vector<TriedEffect>& tried) {
  auto order = ranking(tried);
  const auto first = [&](std::size_t n) {
    return std::set<std::size_t>(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(std::min(n, order.size())));
  };
  auto list = first(4);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return tried[a].candidate.error_of.evidence_train < tried[b].candidate.error_of.evidence_train;
  });
  list.merge(first(2));
  return list;
}

/// The richer law starts where the simple one ended, for parameters of the same name; one that is no refinement of it
/// where it would anyway.
Law started_from(const TriedEffect& t, std::size_t law) {
  Law richer = t.laws[law];
  if (richer.apart) return richer;
  for (const auto& p : parameters_of(t.candidate, static_cast<int>(t.candidate.placed.size()) - 1)) {
    if (p.estimate == nullptr || p.estimate->linear) continue;
    for (auto& q : richer.free)
      if (q.path == p.law->path) {
        q.start = p.estimate->used;
        q.scan = {p.estimate->used, p.estimate->used / 2};
      }
  }
  return richer;
}

/// Where another effect leaves noise only, each further number takes about one away and costs two: a law with many more
/// of them explains nothing that is not explained.
bool has_too_many_numbers(const TriedEffect& t, std::size_t law, const std::vector<TriedEffect>& tried) {
  const TriedEffect& best = tried[ranking(tried).front()];
  if (best.effect == t.effect || best.candidate.error_of.over_floor() > rules::floor_gate) return false;
  return t.laws[law].free.size() > best.laws[best.law].free.size() + rules::too_many_numbers;
}

/// Indices of the laws, beside the first, that are tried of each candidate, given as indices of `tried`.
std::vector<std::vector<std::size_t>> laws_to_enrich_by(const SearchState& state, const std::vector<TriedEffect>& tried,
                                                        const std::vector<std::size_t>& order, int step, As as) {
  const bool far = step == 1 && tried[order.front()].candidate.error_of.over_floor() > 3;
  const auto left = left_by_laws(state, as);
  const TriedEffect& best = tried[order.front()];
  const bool decided = best.admitted && best.share > rules::decided;
  std::vector<std::vector<std::size_t>> lists;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const TriedEffect& t = tried[order[k]];
    auto& list = lists.emplace_back();
    // A law that brings nothing in its simple form has nothing to enrich.
    const bool promising = (far || k < static_cast<std::size_t>(rules::enriched)) && t.fall_validate > 0 &&
                           (step == 1 || within_reach(state, t, left));
    // What is not a refinement may bring what the simple form does not; where somebody takes almost all, it would have
    // to look like that one.
    const bool apart_too = !decided || t.effect == best.effect || look_alike(*t.effect, *best.effect);
    for (std::size_t law = 1; law < t.laws.size(); ++law)
      if ((promising || (t.laws[law].apart && apart_too)) && !has_too_many_numbers(t, law, tried)) list.push_back(law);
  }
  return lists;
}

/// A fit that was broken off, or goes on in turn, is gone on with until it brings nothing: beside one that has not
/// ended any other law looks better.
bool fitted_to_its_end(const FitContext& context, TriedEffect& t) {
  constexpr int most = 4;
  bool better = false;
  for (int i = 0; i < most && !stop_asked(); ++i) {
    CandidateModel further = refit(context, t.candidate, Effort::full);
    const double gain = further.ok ? t.candidate.score() - further.score() : 0;
    if (!(gain > 0)) break;
    t.candidate = std::move(further);
    better = true;
    if (gain < rules::alike) break;
  }
  return better;
}

/// The candidate by this law, if that is better, and what to record of it. On top of others these are held where the
/// simple law had them: there it was fitted together with them, and nowhere else does its refinement fit better.
TriedLaw enriched(const SearchState& state, const FitContext& context, TriedEffect& t, std::size_t law, int step) {
  std::optional<CandidateModel> as_found;
  if (step > 1 && t.candidate.placed.back().weights.empty()) as_found = before_last(context, t.candidate);
  CandidateModel richer = with_effect(context, as_found ? *as_found : state.current, *t.effect, started_from(t, law),
                                      t.place, t.excitation, step == 1 ? Effort::full : Effort::screen);
  if (step > 1 && richer.ok && richer.score() < t.candidate.score()) {
    CandidateModel together = refit(context, richer, Effort::full);
    if (together.ok) richer = std::move(together);
  }
  // For the same, fewer numbers are taken: a spare pole stands where a lag is not, and is in everybody's way there.
  const double gain = t.laws[law].free.size() > t.laws[t.law].free.size() ? rules::alike : 0;
  TriedLaw tried = tried_law(t.laws[law], richer, state.current.error_of);
  if (!richer.ok) return tried;
  tried.reason = why_no_better(richer, t.candidate, t.laws[t.law], gain);
  // What makes it better is then not the effect: a second mode at the limit of damping is somebody's lag.
  if (tried.reason.empty()) tried.reason = why_implausible(*t.effect, t.laws[law], richer, t.excitation);
  if (!tried.reason.empty()) return tried;
  tried.taken = true;
  t.candidate = std::move(richer);
  t.law = law;
  return tried;
}

}  // namespace

std::vector<double> left_by_laws_of(const SearchState& state, const CandidateModel& model) {
  if (model.placed.empty()) return {};
  // A gain and a zero are exact: what is left behind them is called a curve.
  Prediction begun = state.base.prediction;
  for (const auto& s : model.placed)
    if (calibrates(s))
      for (const int o : measured_moved(state, model, s.place.moves_from()))
        begun = state.evidence->calibrated(std::move(begun), o);
  const auto base = state.evidence->chi2_beside_lines(begun);
  const auto now = state.evidence->chi2_beside_lines(model.prediction);
  std::vector<double> left;
  for (std::size_t i = 0; i < base.size(); ++i)
    left.push_back(rules::own_law_left * rules::own_law_left * std::max(0.0, base[i] - now[i]));
  return left;
}

std::vector<double> left_by_laws(const SearchState& state, As as) {
  return as == As::first ? std::vector<double>{} : left_by_laws_of(state, state.current);
}

std::vector<std::size_t> ranking(const std::vector<TriedEffect>& tried) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < tried.size(); ++i)
    if (tried[i].candidate.ok) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return tried[a].candidate.score() < tried[b].candidate.score();
  });
  return order;
}

int best_admitted(const std::vector<TriedEffect>& tried) {
  const auto numbers = [&](int i) {
    const TriedEffect& t = tried[static_cast<std::size_t>(i)];
    return t.laws[t.law].free.size();
  };
  int best = -1;
  double least = 0;
  for (const std::size_t i : ranking(tried)) {
    const TriedEffect& t = tried[i];
    if (!t.admitted) continue;
    if (best < 0) least = t.candidate.score();
    if (t.candidate.score() > least + rules::alike) break;
    const int next = static_cast<int>(i);
    if (best < 0 || numbers(next) < numbers(best)) best = next;
  }
  return best;
}

void compare_all(SearchState& state, std::vector<TriedEffect>& tried, As as) {
  state.evidence->settle(best_of_each_output(state, tried));
  state.current.error_of = state.evidence->error(state.current.prediction);
  const auto left = left_by_laws(state, as);
  for (auto& t : tried) {
    if (t.candidate.ok) t.candidate.error_of = state.evidence->error(t.candidate.prediction);
    judge(*state.evidence, t, state.current, left);
  }
  leave_to_calibration(tried, left);
}

void refit_best(SearchState& state, std::vector<TriedEffect>& tried, As as, double progress) {
  const auto worth = worth_a_fit(tried);
  const auto left = left_by_laws(state, as);
  std::vector<std::size_t> together, screened_out;
  for (const std::size_t i : ranking(tried))
    (worth.contains(i) && within_reach(state, tried[i], left) ? together : screened_out).push_back(i);
  state.side_by_side(together.size(), [&](std::size_t k, const FitContext& context) {
    TriedEffect& t = tried[together[k]];
    state.progress("together with what was found: " + t.effect->id, progress);
    CandidateModel better = refit(context, t.candidate, Effort::full);
    if (better.ok) t.candidate = std::move(better);
    return false;
  });
  compare_all(state, tried, as);
  for (const std::size_t i : screened_out) tried[i].admitted = false;
}

void enrich(SearchState& state, std::vector<TriedEffect>& tried, int step, As as, double progress) {
  const auto order = ranking(tried);
  if (order.empty()) return;
  const auto laws = laws_to_enrich_by(state, tried, order, step, as);
  std::atomic<bool> any = false;
  state.side_by_side(order.size(), [&](std::size_t k, const FitContext& context) {
    TriedEffect& t = tried[order[k]];
    // A law that stands apart begins nowhere near the simple one.
    const bool refines = std::any_of(laws[k].begin(), laws[k].end(), [&](std::size_t l) { return !t.laws[l].apart; });
    if (step > 1 && refines && fitted_to_its_end(context, t)) any = true;
    if (!laws[k].empty()) record_present(t, state.current.error_of);
    for (const std::size_t law : laws[k]) {
      if (state.stopped()) break;
      state.progress(fmt::format("{}: {}", t.effect->id, t.laws[law].name), progress);
      record(t.laws_tried, enriched(state, context, t, law, step));
      if (t.laws_tried.back().taken) any = true;
    }
    return false;
  });
  if (any) compare_all(state, tried, as);
}

void refine(const SearchState& state, const FitContext& context, TriedEffect& t) {
  const std::size_t begun = t.law;
  for (std::size_t law = 1; law < t.laws.size() && !state.stopped(); ++law)
    if (law != begun && !t.laws[law].apart) enriched(state, context, t, law, 2);
}

void try_hidden(SearchState& state, std::vector<TriedEffect>& tried, const Effect& winner, As as) {
  const auto left = left_by_laws(state, as);
  for (auto& t : state.hidden) {
    if (!look_alike(*t.effect, winner) || state.stopped()) continue;
    t.laws = t.effect->laws(t.excitation);
    if (t.laws.empty() || same_finding(tried, t) != nullptr) continue;
    t.candidate =
        with_effect(state.context, state.current, *t.effect, t.laws.front(), t.place, t.excitation, Effort::full);
    if (t.candidate.ok) t.candidate.error_of = state.evidence->error(t.candidate.prediction);
    judge(*state.evidence, t, state.current, left);
    t.hidden = true;
    tried.push_back(std::move(t));
  }
  state.hidden.clear();
}

}  // namespace hysteron
