// Decides whether a discovery begins with another effect, or goes on with two at once: greedy search takes the one that
// explains most alone, and the pair that explains everything need not hold it; nor need either of the pair be more than
// a patch without the other.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "discover/search/books.h"

namespace hysteron {
namespace {

constexpr int most_beginnings = 3;  // names that are tried in its place
constexpr int patches = 2;     // on which another one is tried: what takes least seldom holds one of the pair

/// The best admitted effect on top of the present model, fitted together with it. `begun` is none: beside that one the
/// present effect was refused.
std::optional<Tried> with_one_more(Books& books, const std::string& begun) {
  auto tried = list_candidates(books, 2);
  fit_candidates(books, tried, 2);
  join_twins(tried);
  std::erase_if(tried, [&](const Tried& t) { return t.effect->id == begun; });
  compare_all(books, tried, As::further);
  refit_best(books, tried, As::further, 0.9);
  enrich(books, tried, 2, As::further, 0.9);
  const int best = best_admitted(tried);
  if (best < 0) return std::nullopt;
  return std::move(tried[static_cast<std::size_t>(best)]);
}

/// Is `first` no patch beside the other one, as that one is none beside it?
bool needs_both(Books& books, const Tried& first, const Tried& second, const std::vector<Tried>& alone) {
  const auto other = std::find_if(alone.begin(), alone.end(), [&](const Tried& t) {
    return t.effect == second.effect && t.place.where() == second.place.where() && t.contender.ok;
  });
  if (other == alone.end()) return false;
  Contender without = other->contender;
  without.error_of = books.evidence->error(without.prediction);
  Tried t = first;
  t.contender = second.contender;
  t.contender.error_of = books.evidence->error(t.contender.prediction);
  judge(*books.evidence, t, without, left_by_laws_of(books, without));
  return t.admitted;
}

/// Two effects in the place of one explain most of what that one leaves: its law need not be more than nearly right.
bool is_worth_two(const Contender& pair, const Contender& stands) {
  return pair.standing.size() <= stands.standing.size() ||
         pair.error_of.excess_validate() < 0.5 * stands.error_of.excess_validate();
}

/// On top of a patch nobody else was: the pair is told only if nothing but noise is left.
bool leaves_only_noise(const Books& books, const Contender& c) {
  return books.evidence->over_usual_floor(c.prediction).all <= rules::floor_gate;
}

}  // namespace

bool another_beginning(Books& books, const std::vector<Tried>& first) {
  if (books.stopped() || books.options.max_steps < 2) return false;
  if (books.evidence->over_usual_floor(books.current.prediction).all <= rules::floor_gate) return false;
  const Contender stands = books.current;
  const std::string begun = books.d.steps.empty() ? "" : books.d.steps.front().winner.effect;
  std::optional<Contender> best;
  int tried = 0;
  for (const std::size_t i : ranking(first)) {
    if (tried == most_beginnings || books.stopped()) break;
    const Tried& t = first[i];
    if (!(begun.empty() ? t.patch : t.admitted) || t.effect->id == begun) continue;
    ++tried;
    books.progress("beginning with " + t.effect->id, 0.9);
    books.current = t.contender;
    books.settle(books.current);
    const auto pair = with_one_more(books, begun);
    if (!pair || (begun.empty() && !needs_both(books, t, *pair, first))) continue;
    if (!best || pair->contender.error_of.rms_validate < best->error_of.rms_validate) best = pair->contender;
  }
  books.current = stands;
  if (!best) return false;
  books.settle(*best);
  books.current.error_of = books.evidence->error(books.current.prediction);
  if (best->score() < books.current.score() - rules::exchange &&
      (begun.empty() || is_worth_two(*best, books.current)) && tell_again(books, *best)) {
    reconsider(books, 0.95, Came::at_once);
    return true;
  }
  books.settle(books.current);
  return false;
}

bool no_patch_of_anything(Books& books, const std::vector<Tried>& first) {
  if (books.stopped() || !books.d.steps.empty()) return false;
  const auto order = ranking(first);
  const auto patch = std::find_if(order.begin(), order.end(), [&](std::size_t i) { return first[i].patch; });
  if (patch == order.end() || leaves_something_unexplained(books)) return false;
  if (!tell_again(books, first[*patch].contender)) return false;
  reconsider(books, 0.95, Came::at_once);
  return true;
}

bool two_more(Books& books, const std::vector<Tried>& last) {
  if (books.stopped() || found_effects(books) + 2 > books.options.max_steps) return false;
  if (leaves_only_noise(books, books.current)) return false;
  const Contender stands = books.current;
  std::optional<Contender> best;
  int tried = 0;
  for (const std::size_t i : ranking(last)) {
    if (tried == patches || books.stopped()) break;
    const Tried& t = last[i];
    if (!t.patch) continue;
    ++tried;
    books.progress("two at once: " + t.effect->id, 0.9);
    books.current = refit(books.shop, t.contender, Effort::full);
    if (!books.current.ok) continue;
    books.settle(books.current);
    const auto pair = with_one_more(books, "");  // the same, in another block, too
    books.settle(books.current);
    if (!pair || !leaves_only_noise(books, pair->contender) || !needs_both(books, t, *pair, last)) continue;
    if (!best || pair->contender.score() < best->score()) best = pair->contender;
  }
  books.current = stands;
  books.settle(books.current);
  if (!best || !tell_again(books, *best)) return false;
  reconsider(books, 0.95, Came::at_once);
  return true;
}

}  // namespace hysteron
