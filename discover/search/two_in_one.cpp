// Decides whether a law that holds another effect's besides its own (Law::holds) stands for both: whether a plainer law
// and that effect, each by itself, explain the recordings better.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "discover/placement/excitation.h"
#include "discover/search/search_state.h"

namespace hysteron {
namespace {

/// Of those that were screened: the law that takes most when it stands alone need not be the one that fits best beside
/// the plain one.
constexpr std::size_t held_ones_fitted = 3;

/// Of those that could be fitted.
std::optional<CandidateModel> best_of(std::vector<CandidateModel> fitted) {
  std::optional<CandidateModel> best;
  for (auto& c : fitted)
    if (c.ok && (!best || c.score() < best->score())) best = std::move(c);
  return best;
}

/// The effect of `mixed` on `before`, by its best law that holds no other one's.
std::optional<CandidateModel> by_a_plain_law(const SearchState& state, const CandidateModel& before,
                                             const PlacedEffect& mixed) {
  const auto at = circumstances_on(state, before, {mixed.place}).front();
  auto laws = mixed.effect->laws(at);
  std::erase_if(laws, [](const Law& law) { return !law.holds.empty(); });
  std::vector<CandidateModel> plain(laws.size());
  state.side_by_side(laws.size(), [&](std::size_t i, const FitContext& context) {
    plain[i] = with_effect(context, before, *mixed.effect, laws[i], mixed.place, at, Effort::full);
    return false;
  });
  return best_of(std::move(plain));
}

/// `plain` with one of the effects that the mixed law could hold, by the best of its laws at the best of its places:
/// screened with the plain law held, the best few are fitted together with it.
std::optional<CandidateModel> with_a_held_one(const SearchState& state, const CandidateModel& plain, const Law& mixed,
                                              double progress) {
  const auto list = choices_on(
      state, plain, [&](const Effect& e) { return could_hold(state, mixed, e); },
      [](const Effect& e, const Excitation& at) { return e.laws(at); });
  std::vector<CandidateModel> fitted(list.size());
  state.side_by_side(list.size(), [&](std::size_t i, const FitContext& context) {
    const auto& [effect, law, place, at] = list[i];
    state.progress(fmt::format("{} beside {}, each by itself", effect->id, plain.placed.back().effect->id), progress);
    fitted[i] = with_effect(context, plain, *effect, law, place, at, Effort::screen);
    return false;
  });
  std::vector<std::size_t> best(list.size());
  std::iota(best.begin(), best.end(), std::size_t{0});
  std::erase_if(best, [&](std::size_t i) { return !fitted[i].ok; });
  std::stable_sort(best.begin(), best.end(),
                   [&](std::size_t a, std::size_t b) { return fitted[a].score() < fitted[b].score(); });
  best.resize(std::min(best.size(), held_ones_fitted));
  std::vector<CandidateModel> together(best.size());
  state.side_by_side(best.size(), [&](std::size_t k, const FitContext& context) {
    const auto& [effect, law, place, at] = list[best[k]];
    CandidateModel both = refit(context, fitted[best[k]], Effort::full);
    if (both.ok && why_implausible(*effect, law, both, at).empty()) together[k] = std::move(both);
    return false;
  });
  return best_of(std::move(together));
}

/// Is the other effect more than what the plainer law may have left of its own?
bool is_no_rest(const CandidateModel& before, const CandidateModel& plain, const CandidateModel& both) {
  const double of_law = before.error_of.evidence() - plain.error_of.evidence();
  return plain.error_of.evidence() - both.error_of.evidence() > rules::plain_left * rules::plain_left * of_law;
}

}  // namespace

bool could_hold(const SearchState& state, const Law& law, const Effect& e) {
  return std::any_of(law.holds.begin(), law.holds.end(), [&](const std::string& id) {
    const Effect* held = state.effects.find(id);
    // A curve has no memory, whatever else looks like it.
    return held != nullptr && (held == &e || (look_alike(*held, e) && held->is_memory == e.is_memory));
  });
}

int held_one_first(const SearchState& state, const std::vector<TriedEffect>& tried, int winner) {
  const TriedEffect& w = tried[static_cast<std::size_t>(winner)];
  const Law& law = w.laws[w.law];
  for (const std::size_t i : ranking(tried)) {
    const TriedEffect& t = tried[i];
    if (t.effect == w.effect || !t.admitted || t.outputs != w.outputs || !could_hold(state, law, *t.effect)) continue;
    if (t.fall_train > rules::held_share * w.fall_train && t.fall_validate > rules::held_share * w.fall_validate)
      return static_cast<int>(i);
  }
  return winner;
}

bool in_two(SearchState& state, CandidateModel before, double progress) {
  const PlacedEffect mixed = state.current.placed.back();
  const auto stands = [&](const PlacedEffect& s) { return could_hold(state, mixed.law, *s.effect); };
  if (mixed.law.holds.empty() || std::any_of(before.placed.begin(), before.placed.end(), stands)) return false;
  state.progress(fmt::format("{} by itself", mixed.effect->id), progress);
  before.error_of = state.evidence->error(before.prediction);  // in the units of the noise as the claim settled it
  const auto plain = by_a_plain_law(state, before, mixed);
  if (!plain) return false;
  const auto best = with_a_held_one(state, *plain, mixed.law, progress);
  return best && best->score() < state.current.score() - rules::exchange && is_no_rest(before, *plain, *best) &&
         tell_again(state, *best);
}

}  // namespace hysteron
