// Decides whether a law that holds another effect's besides its own (Law::holds) stands for both: whether a plainer law
// and that effect, each by itself, explain the recordings better.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "discover/books.h"
#include "discover/circumstances.h"

namespace hysteron {
namespace {

/// `better` in place of `best`, if it is.
void keep_better(std::optional<Contender>& best, Contender better) {
  if (better.ok && (!best || better.score() < best->score())) best = std::move(better);
}

/// The effect of `mixed` on `before`, by its best law that holds no other one's.
std::optional<Contender> by_a_plain_law(Books& books, const Contender& before, const Standing& mixed) {
  const auto at =
      circumstances_at(before.diagram, books.registry, *books.data, mixed.place, free_anyway(books.shop, before));
  std::optional<Contender> best;
  for (const auto& law : mixed.effect->laws(at)) {
    if (!law.holds.empty() || books.stopped()) continue;
    Contender plain = with_effect(books.shop, before, *mixed.effect, law, mixed.place, at, Effort::full);
    books.d.model_runs += plain.runs;
    keep_better(best, std::move(plain));
  }
  return best;
}

/// `plain` with this effect by the best of its laws at the best of its places.
void with_it(Books& books, const Contender& plain, const Effect& e, std::optional<Contender>& best) {
  const auto places = places_of(e, plain.diagram, books.registry, books.data.get());
  if (places.empty()) return;
  const auto at = circumstances_at(plain.diagram, books.registry, *books.data, places, free_anyway(books.shop, plain));
  for (std::size_t p = 0; p < places.size(); ++p) {
    if (!e.unseen(at[p]).empty()) continue;
    for (const auto& law : e.laws(at[p])) {
      if (books.stopped()) return;
      Contender both = with_effect(books.shop, plain, e, law, places[p], at[p], Effort::full);
      books.d.model_runs += both.runs;
      if (both.ok && why_implausible(e, law, both, at[p]).empty()) keep_better(best, std::move(both));
    }
  }
}

/// Is the other effect more than what the plainer law may have left of its own?
bool is_no_rest(const Contender& before, const Contender& plain, const Contender& both) {
  const double of_law = before.error_of.evidence() - plain.error_of.evidence();
  return plain.error_of.evidence() - both.error_of.evidence() > rules::plain_left * rules::plain_left * of_law;
}

}  // namespace

bool could_hold(const Books& books, const Law& law, const Effect& e) {
  return std::any_of(law.holds.begin(), law.holds.end(), [&](const std::string& id) {
    const Effect* held = books.effects.find(id);
    // A curve has no memory, whatever else looks like it.
    return held != nullptr && (held == &e || (look_alike(*held, e) && held->is_memory == e.is_memory));
  });
}

int held_one_first(const Books& books, const std::vector<Tried>& tried, int winner) {
  const Tried& w = tried[static_cast<std::size_t>(winner)];
  const Law& law = w.laws[w.law];
  for (const std::size_t i : ranking(tried)) {
    const Tried& t = tried[i];
    if (t.effect == w.effect || !t.admitted || t.outputs != w.outputs || !could_hold(books, law, *t.effect)) continue;
    if (t.fall_train > rules::held_share * w.fall_train && t.fall_validate > rules::held_share * w.fall_validate)
      return static_cast<int>(i);
  }
  return winner;
}

bool in_two(Books& books, Contender before, double bar) {
  const Standing mixed = books.current.standing.back();
  const auto stands = [&](const Standing& s) { return could_hold(books, mixed.law, *s.effect); };
  if (mixed.law.holds.empty() || std::any_of(before.standing.begin(), before.standing.end(), stands)) return false;
  books.progress(fmt::format("{} by itself", mixed.effect->id), bar);
  before.error_of = books.evidence->error(before.prediction);  // in the units of the noise as the claim settled it
  const auto plain = by_a_plain_law(books, before, mixed);
  if (!plain) return false;
  std::optional<Contender> best;
  for (const auto& e : books.effects.list())
    if (books.wanted(e) && could_hold(books, mixed.law, e)) with_it(books, *plain, e, best);
  return best && best->score() < books.current.score() - rules::exchange && is_no_rest(before, *plain, *best) &&
         tell_again(books, *best);
}

}  // namespace hysteron
