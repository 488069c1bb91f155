// Decides what is claimed in a step: the best candidate with its intervals and ties, or the look-alike that the
// recordings prefer once another effect stands beside it.
#include <fmt/format.h>

#include "discover/books.h"
#include "discover/circumstances.h"
#include "discover/wiring.h"

namespace hysteron {
namespace {

/// The reason is told in the units of the noise as settled by the claimed model.
void judge_again(Tried& w, const ModelError& before) {
  Contender was;
  was.ok = true;
  was.error_of = before;
  was.parameters = 0;
  const bool admitted = w.admitted;
  judge(w, was, 0);
  w.admitted = admitted;
}

/// Greedy search takes a look-alike where the right one was masked: in sets of two or more each member is replaced in
/// turn.
void exchange(Books& books, Tried& w, double bar) {
  for (std::size_t i = 0; i + 1 < books.current.standing.size() && !books.stopped(); ++i) {
    const Effect& member = *books.current.standing[i].effect;
    for (const auto& e : books.effects.list()) {
      if (!books.wanted(e) || !look_alike(member, e) || (e.family != member.family && standing(books, e))) continue;
      Contender rest = without(books.shop, books.current, i);
      const auto places = places_of(e, rest.diagram, books.registry, books.data.get());
      if (places.empty()) continue;
      const auto at = circumstances_at(rest.diagram, books.registry, *books.data, places, books.options.free_paths);
      for (std::size_t p = 0; p < places.size() && !books.stopped(); ++p) {
        if (!e.unseen(at[p]).empty()) continue;
        books.progress(fmt::format("{} in place of {}", e.id, member.id), bar);
        Contender other = with_effect(books.shop, rest, e, e.laws(at[p]).front(), places[p], at[p], Effort::full);
        books.d.model_runs += other.runs;
        if (!other.ok || other.score() > books.current.score() - rules::exchange) continue;
        books.d.data_remarks.push_back(fmt::format(
            "{} was taken at first; together with {} the recordings speak for {}", member.id, w.effect->id, e.id));
        books.current = std::move(other);
        return;
      }
    }
  }
}

}  // namespace

void claim(Books& books, int step, std::vector<Tried>& tried, std::size_t winner, const std::vector<int>& ties,
           double bar) {
  Tried& w = tried[winner];
  books.progress("intervals of " + w.effect->id, bar);
  FoundStep found;
  found.before = books.current.error_of;
  if (!w.sharp) {
    Contender final = refit(books.shop, w.contender, Effort::final);
    books.d.model_runs += final.runs;
    if (final.ok && final.error_of.evidence() <= w.contender.error_of.evidence() + 1) w.contender = std::move(final);
  }
  for (const int t : ties) {
    found.ties.push_back(candidate_of(tried[static_cast<std::size_t>(t)], step));
    const Tried& rival = tried[static_cast<std::size_t>(t)];
    auto e = experiment_between(books, w, rival);
    // The nearest rival first: what separates a third one best may leave the second.
    if (!e || found.experiment_would_tell) continue;
    found.experiment_would_tell = would_tell(*e, rival.hidden);
    if (found.experiment_would_tell || !found.experiment || e->separation > found.experiment->separation)
      found.experiment = e;
  }
  const ModelError before = books.current.error_of;
  books.current = w.contender;
  if (books.current.standing.size() > 1) exchange(books, w, bar);
  books.settle(books.current);
  found.before =
      books.evidence->error(books.before_prediction.y.empty() ? books.base.prediction : books.before_prediction);
  books.before_prediction = books.current.prediction;
  w.contender.error_of = books.current.error_of;
  judge_again(w, found.before);
  found.after = books.current.error_of;
  found.winner = candidate_of(w, step);
  found.winner.claimed = true;
  found.change = books.current.change;
  found.change.diagram = books.current.diagram;
  found.sentence = step_sentence(w, found.ties, found.before, found.after, output_unit(books));
  books.d.steps.push_back(std::move(found));
}

}  // namespace hysteron
