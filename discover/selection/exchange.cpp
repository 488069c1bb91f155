// Decides what stands in the place of a term of the best model: what can be left out, a look-alike, another law.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "discover/search/ties.h"
#include "discover/selection/joint_step.h"
#include "discover/selection/selection.h"

namespace hysteron {
namespace {

std::size_t place_of(const std::vector<Law>& laws, const std::string& name) {
  const auto here = std::find_if(laws.begin(), laws.end(), [&](const Law& l) { return l.name == name; });
  return here == laws.end() ? 0 : static_cast<std::size_t>(here - laws.begin());
}

}  // namespace

/// Of a single term that is the user's own model from other numbers than it had been searched from.
TableModel Selection::rest_without(const std::vector<std::size_t>& term) {
  TableModel rest = without_term(setting_, state_.context, best_, term);
  if (rest.ok()) rest = refitted(setting_, state_.context, rest, best_.numbers);
  if (!rest.ok()) return rest;
  remember(rest);
  measure();
  if (rest.model.placed.empty() && score_of(rest) > score_of(nulls_.better(score())))
    (rest.numbers == Numbers::let_go ? nulls_.let_go : nulls_.written) = rest;
  return rest;
}

/// A term that its model does not need: the rest explains as much.
bool Selection::leave_out() {
  for (const auto& term : terms_of(best_.model)) {
    TableModel rest = rest_without(term);
    if (!rest.ok() || score_of(rest) + rules::by_score < score_of(best_)) continue;
    best_ = std::move(rest);
    return true;
  }
  return false;
}

bool Selection::leave(const std::vector<std::size_t>& term) {
  TableModel rest = rest_without(term);
  if (!rest.ok()) return false;
  best_ = rest.model.placed.empty() ? nulls_.better(score()) : std::move(rest);
  return true;
}

void Selection::fit_on(const TableModel& rest, std::vector<Addition>& rivals) {
  std::vector<FitsOfRival> answers(rivals.size());
  state_.side_by_side(rivals.size(), [&](std::size_t k, const FitContext& context) {
    const std::size_t law = rivals[k].tried.law;
    const TableModel f = with_term(setting_, context, rest, term_of(rivals[k], law),
                                   ln_tried(rivals, *rivals[k].tried.effect), Effort::full);
    if (!f.ok()) return false;
    const bool may_tie = may_reach(setting_, context, f, best_.numbers, -std::numeric_limits<double>::infinity(),
                                   tie_score_of(score(), best_));
    answers[k] = {{k, law, may_tie ? refitted(setting_, context, f, best_.numbers) : f}};
    return false;
  });
  take_up(rivals, std::move(answers));
  for (auto& r : rivals) r.tried.candidate = r.fitted.model;
}

/// What is left by the others without this term, which stand as they are beside it: fitted again without it they would
/// bear what it does, and who comes in its place begins from there.
TableModel Selection::others_as_they_are(const std::vector<std::size_t>& term) const {
  TableModel rest = without_term(setting_, state_.context, best_, term);
  CandidateModel as_they_are = best_.model;
  for (auto i = term.rbegin(); i != term.rend() && as_they_are.ok; ++i)
    as_they_are = without(state_.context, as_they_are, *i);
  if (rest.ok() && as_they_are.ok) {
    as_they_are.prediction = std::move(rest.model.prediction);
    as_they_are.before_rounding = std::move(rest.model.before_rounding);
    rest.model = std::move(as_they_are);
  }
  return rest;
}

/// Of what list_candidates() has just found hidden, what looks like this effect.
std::vector<Addition> Selection::take_hidden(const Effect& effect) {
  std::vector<Addition> rivals;
  for (auto& t : state_.hidden) {
    if (!look_alike(*t.effect, effect)) continue;
    t.laws = t.effect->laws(t.excitation);
    t.hidden = true;
    Addition rival;
    rival.tried = std::move(t);
    if (!rival.tried.laws.empty()) rivals.push_back(std::move(rival));
  }
  state_.hidden.clear();
  return rivals;
}

std::vector<Addition> Selection::hidden_in_place_of(const Effect& effect) {
  const TableModel& null = nulls_.better(score());
  const CandidateModel was = std::exchange(state_.current, null.model);
  list_candidates(state_, 2);
  state_.current = was;
  auto rivals = take_hidden(effect);
  fit_on(null, rivals);
  return rivals;
}

std::vector<Addition> Selection::in_place_of(const std::vector<std::size_t>& term) {
  std::vector<Addition> rivals;
  const PlacedEffect& leaving = best_.model.placed[term.front()];
  const TableModel rest = others_as_they_are(term);
  if (!rest.ok()) return rivals;
  const CandidateModel was = std::exchange(state_.current, rest.model);
  for (auto& r : everywhere(2)) {
    const bool same = r.tried.effect == leaving.effect;
    const bool itself = same && r.tried.place.where() == leaving.place.where() && r.also.size() + 1 == term.size();
    const bool held = !same && could_hold(state_, leaving.law, *r.tried.effect);
    const bool alike = look_alike(*r.tried.effect, *leaving.effect) || is_plainer(*r.tried.effect, *leaving.effect);
    if (same ? !itself : !held && !alike) continue;
    if (itself) r.tried.law = place_of(r.tried.laws, leaving.law.name);
    // What the law could hold besides its own, alone, may be all of it: by any of its laws.
    for (std::size_t law = 1; held && law < r.tried.laws.size(); ++law) {
      rivals.push_back(r);
      rivals.back().tried.law = law;
    }
    rivals.insert(itself ? rivals.begin() : rivals.end(), std::move(r));
  }
  state_.current = was;
  for (auto& hidden : take_hidden(*leaving.effect)) rivals.push_back(std::move(hidden));
  fit_on(rest, rivals);
  std::stable_sort(rivals.begin(), rivals.end(), [&](const Addition& a, const Addition& b) {
    const auto rank = [&](const Addition& r) { return std::pair(r.tried.effect != leaving.effect, !r.fitted.ok()); };
    if (rank(a) != rank(b)) return rank(a) < rank(b);
    return a.fitted.ok() && score_of(a.fitted) > score_of(b.fitted);
  });
  return rivals;
}

/// `on` with one more effect, by each of the laws that `takes` says of those that are offered there, best score first.
std::vector<Addition> Selection::by_laws(const TableModel& on,
                                         const std::function<bool(const Addition&, const Law&)>& takes) {
  std::vector<Addition> rivals;
  const CandidateModel was = std::exchange(state_.current, on.model);
  for (const auto& r : everywhere(2))
    for (std::size_t law = 0; law < r.tried.laws.size(); ++law)
      if (takes(r, r.tried.laws[law])) {
        rivals.push_back(r);
        rivals.back().tried.law = law;
      }
  state_.current = was;
  fit_on(on, rivals);
  sort(rivals);
  return rivals;
}

/// One term of the best model by its other laws: which was chosen while others were missing.
std::vector<Addition> Selection::by_other_laws(const std::vector<std::size_t>& term) {
  const PlacedEffect standing = best_.model.placed[term.front()];
  const TableModel rest = others_as_they_are(term);
  if (!rest.ok()) return {};
  return by_laws(rest, [&](const Addition& r, const Law& law) {
    return r.tried.effect == standing.effect && r.tried.place.where() == standing.place.where() &&
           r.also.size() + 1 == term.size() && law.name != standing.law.name;
  });
}

/// Where the law of a term can hold another effect besides its own: a plainer law of the same effect and that other
/// one, each by itself, if they explain more.
bool Selection::in_two() {
  if (state_.stopped() || static_cast<int>(names_of(best_.model).size()) >= state_.options.max_steps) return false;
  for (const auto& term : terms_of(best_.model)) {
    const PlacedEffect mixed = best_.model.placed[term.front()];
    const auto stands = [&](const PlacedEffect& s) { return could_hold(state_, mixed.law, *s.effect); };
    if (mixed.law.holds.empty() || term.size() > 1 ||
        std::any_of(best_.model.placed.begin(), best_.model.placed.end(), stands))
      continue;
    const TableModel rest = others_as_they_are(term);
    if (!rest.ok()) continue;
    const auto plain = by_laws(rest, [&](const Addition& r, const Law& law) {
      return r.tried.effect == mixed.effect && r.tried.place.where() == mixed.place.where() && r.also.empty() &&
             law.holds.empty();
    });
    if (plain.empty() || !plain.front().fitted.ok()) continue;
    for (const auto& both : by_laws(plain.front().fitted, [&](const Addition&r, const Law&) {
           return r.also.empty() && could_hold(state_, mixed.law, *r.tried.effect);
         })) {
      if (!both.fitted.ok() || score_of(both.fitted) <= score_of(best_) + rules::exchange) break;
      if (!is_itself(both)) continue;
      best_ = both.fitted;
      return true;
    }
  }
  return false;
}

/// In the place of a term a look-alike, what its law could hold besides its own, or another of its laws, that explains
/// more; what asks for less to be believed where it explains as much.
bool Selection::exchange() {
  const auto terms = terms_of(best_.model);
  const auto take_better = [&](const Effect& standing, const std::vector<Addition>& rivals) {
    for (const auto& r : rivals) {
      if (!r.fitted.ok() || r.tried.hidden || !is_itself(r)) continue;
      const bool as_good = is_plainer(*r.tried.effect, standing) &&
                           tie_score_of(score(), r.fitted) > tie_score_of(score(), best_) - rules::tie;
      if (!as_good && score_of(r.fitted) <= score_of(best_) + rules::exchange) continue;
      best_ = r.fitted;
      return true;
    }
    return false;
  };
  for (std::size_t i = 0; i + 1 < terms.size(); ++i) {
    const Effect& standing = *best_.model.placed[terms[i].front()].effect;
    if (take_better(standing, in_place_of(terms[i]))) return true;
    if (take_better(standing, by_other_laws(terms[i]))) return true;
  }
  return false;
}

}  // namespace hysteron
