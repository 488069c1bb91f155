// Decides what a claim says: the best candidate of a step with its intervals, its ties, and the experiment that would
// break them.
#include "discover/books.h"
#include "discover/tie_experiment.h"

namespace hysteron {
namespace {

/// The reason is told in the units of the noise as settled by the claimed model.
void judge_again(const Evidence& evidence, Tried& w, const ModelError& before) {
  Contender was;
  was.ok = true;
  was.error_of = before;
  was.parameters = 0;
  const bool admitted = w.admitted;
  judge(evidence, w, was, {});
  w.admitted = admitted;
  if (admitted && w.patch) w.reason = what_it_takes(w);  // by itself it is one, and not as it was claimed
}

}  // namespace

void add_tie(Books& books, int step, FoundStep& found, const Tried& winner, const Tried& rival) {
  found.ties.push_back(candidate_of(rival, step));
  auto e =
      found.experiment ? with_another_rival(books, *found.experiment, rival) : experiment_between(books, winner, rival);
  if (!e) return;
  found.experiment_would_tell = e->rivals_told > 0;
  found.experiment = std::move(e);
}

bool stays_itself(const Books& books, Tried& t) {
  if (t.sharp || t.finished) return t.admitted;
  Contender final = refit(books.shop, t.contender, Effort::final);
  const bool better = final.ok && final.error_of.evidence() <= t.contender.error_of.evidence() + 1;
  t.finished = better ? std::move(final) : t.contender;
  const auto why = why_implausible(*t.effect, t.laws[t.law], *t.finished, t.circumstances);
  if (why.empty()) return true;
  t.admitted = false;
  t.reason = "fitted to its end: " + why;
  return false;
}

void claim(Books& books, int step, std::vector<Tried>& tried, std::size_t winner, const std::vector<int>& ties,
           double bar) {
  Tried& w = tried[winner];
  books.progress("intervals of " + w.effect->id, bar);
  FoundStep found;
  found.before = books.current.error_of;
  stays_itself(books, w);
  if (w.finished) w.contender = *w.finished;
  for (const int t : ties) add_tie(books, step, found, w, tried[static_cast<std::size_t>(t)]);
  take(books, step, w, std::move(found));
}

void take(Books& books, int step, Tried& w, FoundStep found) {
  books.current = w.contender;
  books.settle(books.current);
  found.before =
      books.evidence->error(books.before_prediction.y.empty() ? books.base.prediction : books.before_prediction);
  books.before_prediction = books.current.prediction;
  w.contender.error_of = books.current.error_of;
  judge_again(*books.evidence, w, found.before);
  found.after = books.current.error_of;
  found.winner = candidate_of(w, step);
  found.winner.claimed = true;
  found.change = books.current.change;
  found.change.diagram = books.current.diagram;
  found.sentence = step_sentence(w, found.ties, found.before, found.after);
  books.d.steps.push_back(std::move(found));
}

}  // namespace hysteron
