// Decides whether a discovery begins with another effect: greedy search takes the one that explains most alone, and the
// pair that explains everything need not hold it.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "discover/books.h"

namespace hysteron {
namespace {

constexpr int beginnings = 3;  // names that are tried in its place

/// The best admitted effect on top of the present model, fitted together with it. `begun` is none: beside that one the
/// present effect was refused.
std::optional<Contender> with_one_more(Books& books, const std::string& begun) {
  auto tried = list_candidates(books, 2);
  fit_candidates(books, tried, 2);
  join_twins(tried);
  std::erase_if(tried, [&](const Tried& t) { return t.effect->id == begun; });
  compare_all(books, tried, As::further);
  refit_best(books, tried, As::further, 0.9);
  enrich(books, tried, 2, As::further, 0.9);
  const int best = best_admitted(tried);
  if (best < 0) return std::nullopt;
  return std::move(tried[static_cast<std::size_t>(best)].contender);
}

}  // namespace

bool another_beginning(Books& books, const std::vector<Tried>& first) {
  if (books.stopped() || books.options.max_steps < 2) return false;
  if (books.evidence->over_usual_floor(books.current.prediction).all <= rules::floor_gate) return false;
  const Contender stands = books.current;
  const std::string begun = books.d.steps.front().winner.effect;
  std::optional<Contender> best;
  int tried = 0;
  for (const std::size_t i : ranking(first)) {
    if (tried == beginnings || books.stopped()) break;
    const Tried& t = first[i];
    if (!t.admitted || t.effect->id == begun) continue;
    ++tried;
    books.progress("beginning with " + t.effect->id, 0.9);
    books.current = t.contender;
    books.settle(books.current);
    auto pair = with_one_more(books, begun);
    if (pair && (!best || pair->error_of.rms_validate < best->error_of.rms_validate)) best = std::move(pair);
  }
  books.current = stands;
  if (!best) return false;
  books.settle(*best);
  books.current.error_of = books.evidence->error(books.current.prediction);
  if (best->score() < books.current.score() - rules::exchange && tell_again(books, *best)) return true;
  books.settle(books.current);
  return false;
}

}  // namespace hysteron
