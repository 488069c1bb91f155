#include "discover/selection/told.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "discover/models/fit_candidate_model.h"

namespace hysteron {
namespace {

Numbers numbers_in(const Told& told) { return told.kept.empty() ? Numbers::written : Numbers::let_go; }

/// What a model fitted by `told.context` leaves in all recordings.
TableModel measured_as_told(const FitSetting& setting, const Told& told, const TableModel& best,
                            const CandidateModel& c) {
  TableModel m = measured(setting, c, numbers_in(told), *told.context.weights, best.tried);
  if (m.rounded) m.levels = std::make_shared<const LevelsFound>(LevelsFound{*m.rounded, m.left});
  return m;
}

/// The same of each model of its chain.
std::vector<TableModel> measured_chain(const FitSetting& setting, const Told& told, const TableModel& best) {
  std::vector<TableModel> models;
  for (const auto& c : told.chain) models.push_back(measured_as_told(setting, told, best, c));
  return models;
}

/// The model without one of its effects, fitted from where it stands.
CandidateModel rest_without(const FitContext& context, CandidateModel model, const Effect* gone) {
  for (std::size_t i = model.placed.size(); i-- > 0 && model.ok;)
    if (model.placed[i].effect == gone) model = without(context, model, i);
  return model.ok ? refit(context, model, Effort::full) : model;
}

/// The whole model, fitted by `told.context`, and what it is without its last terms: of those that stand the one leaves
/// first that it can best do without, wherever that was found on the way. Where it cannot be fitted without all of
/// them, the user's own.
void fit_chain(Told& told, const SearchState& state, CandidateModel whole, bool must_be_fitted,
               const std::function<double(const CandidateModel&)>& score) {
  CandidateModel final;
  state.unless_stopped([&] { final = refit(told.context, whole, Effort::final); });
  if (final.ok || must_be_fitted) whole = std::move(final);
  told.terms = terms_of(whole);
  told.chain.assign(told.terms.size() + 1, whole);
  for (std::size_t k = told.terms.size(); k-- > 0 && whole.ok;) {
    double most = -std::numeric_limits<double>::infinity();
    CandidateModel best;
    for (std::size_t i = k + 1; i-- > 0;) {  // what was found last first
      CandidateModel rest = rest_without(told.context, told.chain[k + 1], whole.placed[told.terms[i].front()].effect);
      const double reached = rest.ok && k > 0 ? score(rest) : 0;
      if (!rest.ok || (best.ok && reached <= most)) continue;
      most = reached;
      best = std::move(rest);
      std::rotate(told.terms.begin() + static_cast<std::ptrdiff_t>(i),
                  told.terms.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                  told.terms.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    }
    told.chain[k] = best.ok ? std::move(best) : k == 0 ? state.base : told.chain[k + 1];
  }
}

/// Does each of them explain so much more than the one before it?
bool each_explains_more(const BlockScore& score, const std::vector<TableModel>& chain, double more) {
  for (std::size_t k = 0; k + 1 < chain.size(); ++k)
    if (score_of(score, chain[k + 1]) < score_of(score, chain[k]) + more) return false;
  return true;
}

/// A term that with the numbers by which it is told is not itself; nullptr = each is.
const std::vector<std::size_t>* not_itself(const Told& told) {
  const CandidateModel& whole = told.chain.back();
  for (const auto& term : told.terms)
    for (const std::size_t i : term)
      if (whole.ok && !why_implausible(whole, i).empty()) return &term;
  return nullptr;
}

/// Is what the recordings to fit to make of it true of those to judge, too? Numbers of their own would there be worth
/// their price otherwise (Schwarz), or an error would rise. `best`: what was found in all of them.
bool is_true_of_all(const FitSetting& setting, const SearchState& state, const BlockScore& score, const Told& told,
                    const TableModel& best) {
  if (!told.chain.back().ok || not_itself(told) != nullptr) return false;
  auto chain = measured_chain(setting, told, best);
  if (chain.size() == 1 && !told.kept.empty())
    chain.insert(chain.begin(), measured(setting, state.base, Numbers::written, *told.context.weights, {}));
  const auto numbers = static_cast<int>(told.chain.back().fit.estimates.size());
  return each_explains_more(score, chain, 0) &&
         score_of(score, chain.back()) > score_of(score, best) - score.price(numbers);
}

/// See to_be_told(), whether its terms are themselves or not.
Told with_these_terms(SearchState& state, SearchState& searched, const Selection& selection) {
  Told told;
  const FitSetting& setting = selection.setting();
  TableModel best = selection.best();
  if (best.numbers == Numbers::let_go)
    state.unless_stopped(
        [&] { best = with_fewest_numbers(setting, searched.context, selection.score(), best, told.kept); });
  const FitSetting few = setting.with(told.kept);
  told.context = context_for(few, state.context, weights_of(few, best), numbers_in(told));
  const auto all = std::exchange(told.context.data, state.data);  // others judge
  const auto of_all = std::exchange(told.context.derivatives, std::make_shared<DerivativeStore>());
  const bool elsewhere = &state != &searched;
  CandidateModel whole = best.model;
  if (elsewhere) whole.cuts.clear();  // rows of others
  const auto scores = [&](const Told& as) {
    return [&](const CandidateModel& c) { return score_of(selection.score(), measured_as_told(few, as, best, c)); };
  };
  fit_chain(told, state, whole, elsewhere, scores(told));
  if (!elsewhere && !is_true_of_all(few, state, selection.score(), told, best)) {
    Told with_all = told;
    with_all.context.data = all;
    with_all.fitted_to_all = true;
    with_all.context.derivatives = std::make_shared<DerivativeStore>();
    fit_chain(with_all, state, std::move(whole), false, scores(with_all));
    if (is_true_of_all(few, state, selection.score(), with_all, best)) std::swap(told, with_all);
    of_all->count(with_all.context.derivatives->runs());
  }
  of_all->count(told.context.derivatives->runs());
  return told;
}

}  // namespace

Told to_be_told(SearchState& state, SearchState& searched, Selection& selection) {
  std::map<std::pair<const Effect*, std::string>, std::string> gone;
  for (;;) {
    Told told = with_these_terms(state, searched, selection);
    const auto* term = not_itself(told);
    if (term == nullptr || !selection.leave(*term)) {
      told.gone = std::move(gone);
      return told;
    }
    const CandidateModel& whole = told.chain.back();
    for (const std::size_t i : *term)
      gone[{whole.placed[i].effect, whole.placed[i].place.where()}] = why_implausible(whole, i);
  }
}

bool holds(const SearchState& all, const Selection& part, const Told& told) {
  if (!told.chain.back().ok) return false;
  const auto chain = measured_chain(FitSetting(all, told.kept), told, part.best());
  std::vector<LeftSums> left;
  for (const auto& m : chain) left.push_back(m.left);
  const BlockScore score(*all.evidence, left);
  if (!each_explains_more(score, chain, rules::by_score)) return false;
  const double left_in_part = part.score().over_noise(part.best().left_at_last());
  return score.over_noise(chain.back().left_at_last()) <= rules::near_noise * std::max(1.0, left_in_part);
}

}  // namespace hysteron
