// Decides which of the effects that were found does nothing any more beside those that came later.
#include <algorithm>

#include "discover/books.h"

namespace hysteron {
namespace {

/// The step that claimed a standing effect; end() if none did.
auto step_of(Books& books, const Standing& s) {
  return std::find_if(books.d.steps.begin(), books.d.steps.end(), [&](const FoundStep& f) {
    return f.winner.effect == s.effect->id && f.winner.place == s.place.where();
  });
}

void forget(Books& books, std::vector<FoundStep>::iterator step) {
  for (auto& c : books.d.candidates)
    if (c.claimed && c.effect == step->winner.effect && c.place == step->winner.place) {
      c.claimed = false;
      c.reason = "does nothing beside what was found later: " + c.reason;
    }
  const auto next = books.d.steps.erase(step);
  if (next == books.d.steps.end()) return;
  next->before = next == books.d.steps.begin() ? books.d.base : std::prev(next)->after;
}

}  // namespace

void leave_out_idle(Books& books) {
  for (std::size_t i = books.current.standing.size(); i-- > 0 && books.current.standing.size() > 1;) {
    const auto step = step_of(books, books.current.standing[i]);
    if (step == books.d.steps.end()) continue;
    Contender rest = without(books.shop, books.current, i);
    rest.prediction =
        predicted(books.shop, rest, books.base_model->recordings(std::vector{Role::train, Role::validate}));
    if (!rest.prediction.ok) continue;
    rest.error_of = books.evidence->error(rest.prediction);
    if (rest.error_of.evidence() - books.current.error_of.evidence() > rules::idle) continue;
    forget(books, step);
    books.current = std::move(rest);
  }
}

}  // namespace hysteron
