// Decides which of the effects that were found is not needed any more beside those that came later, where the search
// for more was broken off. Does not decide what is needed: reconsider.cpp.
#include <algorithm>
#include <optional>
#include <utility>

#include "discover/search/books.h"

namespace hysteron {
namespace {

/// The step that claimed a standing effect; end() if none did.
auto step_of(Books& books, const Standing& s) {
  return std::find_if(books.d.steps.begin(), books.d.steps.end(), [&](const FoundStep& f) {
    return f.winner.effect == s.effect->id && f.winner.place == s.place.where();
  });
}

/// `rest`: what stands without it.
void forget(Books& books, std::vector<FoundStep>::iterator step, const Contender& rest) {
  for (auto& c : books.d.candidates)
    if (c.claimed && c.effect == step->winner.effect && c.place == step->winner.place) {
      c.claimed = false;
      c.reason = "does nothing beside what was found later: " + c.reason;
    }
  const auto next = books.d.steps.erase(step);
  if (next == books.d.steps.end()) return;
  next->before = next == books.d.steps.begin() ? books.d.base : std::prev(next)->after;
  books.d.steps.back().after = rest.error_of;
}

/// The present model without one of its effects, if that does nothing in it.
std::optional<Contender> without_an_idle_one(const Books& books, std::size_t i) {
  Contender rest = without(books.shop, books.current, i);
  if (!rest.ok) return std::nullopt;
  rest.prediction = predicted(books.shop, rest, books.base_model->recordings(std::vector{Role::train, Role::validate}));
  if (!rest.prediction.ok) return std::nullopt;
  rest.error_of = books.evidence->error(rest.prediction);
  if (rest.error_of.evidence() - books.current.error_of.evidence() > rules::idle) return std::nullopt;
  return rest;
}

/// The same where the others, fitted again from where they stand, explain the recordings as well. A fit that was broken
/// off says nothing: what it has not got yet counts for the member.
std::optional<Contender> without_a_needless_one(const Books& books, std::size_t i) {
  if (books.stopped()) return std::nullopt;
  books.progress("once more without " + books.current.standing[i].effect->id, 0.98);
  Contender rest = without(books.shop, books.current, i);
  if (rest.ok) rest = refit(books.shop, rest, Effort::full);
  if (!rest.ok || !is_needless(books, *books.current.standing[i].effect, rest)) return std::nullopt;
  return rest;
}

}  // namespace

void leave_out_idle(Books& books) {
  for (std::size_t i = books.current.standing.size(); i-- > 0 && books.current.standing.size() > 1;) {
    const auto step = step_of(books, books.current.standing[i]);
    if (step == books.d.steps.end()) continue;
    auto rest = without_an_idle_one(books, i);
    // The last one was compared with the others fitted without it when it was claimed.
    if (!rest && std::next(step) != books.d.steps.end()) rest = without_a_needless_one(books, i);
    if (!rest) continue;
    forget(books, step, *rest);
    books.current = std::move(*rest);
  }
}

}  // namespace hysteron
