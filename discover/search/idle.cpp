// Decides which of the effects that were found is not needed any more beside those that came later, where the search
// for more was broken off. Does not decide what is needed: reconsider.cpp.
#include <algorithm>
#include <optional>
#include <utility>

#include "discover/search/search_state.h"

namespace hysteron {
namespace {

/// The step that claimed a standing effect; end() if none did.
auto step_of(SearchState& state, const PlacedEffect& s) {
  return std::find_if(state.d.steps.begin(), state.d.steps.end(), [&](const FoundStep& f) {
    return f.winner.effect == s.effect->id && f.winner.place == s.place.where();
  });
}

/// `rest`: what stands without it.
void forget(SearchState& state, std::vector<FoundStep>::iterator step, const CandidateModel& rest) {
  for (auto& c : state.d.candidates)
    if (c.claimed && c.effect == step->winner.effect && c.place == step->winner.place) {
      c.claimed = false;
      c.reason = "does nothing beside what was found later: " + c.reason;
    }
  const auto next = state.d.steps.erase(step);
  if (next == state.d.steps.end()) return;
  next->before = next == state.d.steps.begin() ? state.d.base : std::prev(next)->after;
  state.d.steps.back().after = rest.error_of;
}

/// The present model without one of its effects, if that does nothing in it.
std::optional<CandidateModel> without_an_idle_one(const SearchState& state, std::size_t i) {
  CandidateModel rest = without(state.context, state.current, i);
  if (!rest.ok) return std::nullopt;
  rest.prediction =
      predicted(state.context, rest, state.base_model->recordings(std::vector{Role::train, Role::validate}));
  if (!rest.prediction.ok) return std::nullopt;
  rest.error_of = state.evidence->error(rest.prediction);
  if (rest.error_of.evidence() - state.current.error_of.evidence() > rules::idle) return std::nullopt;
  return rest;
}

/// The same where the others, fitted again from where they stand, explain the recordings as well. A fit that was broken
/// off says nothing: what it has not got yet counts for the member.
std::optional<CandidateModel> without_a_needless_one(const SearchState& state, std::size_t i) {
  if (state.stopped()) return std::nullopt;
  state.progress("once more without " + state.current.placed[i].effect->id, 0.98);
  CandidateModel rest = without(state.context, state.current, i);
  if (rest.ok) rest = refit(state.context, rest, Effort::full);
  if (!rest.ok || !is_needless(state, *state.current.placed[i].effect, rest)) return std::nullopt;
  return rest;
}

}  // namespace

void leave_out_idle(SearchState& state) {
  for (std::size_t i = state.current.placed.size(); i-- > 0 && state.current.placed.size() > 1;) {
    const auto step = step_of(state, state.current.placed[i]);
    if (step == state.d.steps.end()) continue;
    auto rest = without_an_idle_one(state, i);
    // The last one was compared with the others fitted without it when it was claimed.
    if (!rest && std::next(step) != state.d.steps.end()) rest = without_a_needless_one(state, i);
    if (!rest) continue;
    forget(state, step, *rest);
    state.current = std::move(*rest);
  }
}

}  // namespace hysteron
