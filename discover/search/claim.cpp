// Decides what a claim says: the best candidate of a step with its intervals, its ties, and the experiment that would
// break them.
#include <fmt/format.h>

#include "discover/search/books.h"
#include "discover/search/tie_experiment.h"

namespace hysteron {
namespace {

/// Some effects show their worth only beside those that come after them.
std::string as_one_of_a_set(const Tried& w) {
  return fmt::format(
      "one of a set: before the others it adds {:.0f} to chi2 on recordings not used for the fit, beside them it is "
      "needed",
      -w.fall_validate);
}

/// The reason is told in the units of the noise as settled by the claimed model.
void judge_again(const Evidence& evidence, Tried& w, const ModelError& before) {
  Contender was;
  was.ok = true;
  was.error_of = before;
  was.parameters = 0;
  const bool admitted = w.admitted;
  judge(evidence, w, was, {});
  if (admitted && !w.admitted) w.reason = w.fall_validate > 0 ? what_it_takes(w) : as_one_of_a_set(w);
  w.admitted = admitted;
}

}  // namespace

void add_tie(Books& books, int step, FoundStep& found, const Tried& winner, const Tried& rival) {
  found.ties.push_back(candidate_of(rival, step));
  if (books.stopped()) return;
  auto [e, menu] =
      found.experiment ? with_another_rival(books, *found.experiment, rival) : experiment_between(books, winner, rival);
  if (e || !found.experiment) found.menu = std::move(menu);
  if (!e) return;
  found.experiment_would_tell = e->rivals_told > 0;
  found.experiment = std::move(e);
}

bool stays_itself(const Books& books, Tried& t) {
  if (t.sharp || t.finished) return t.admitted;
  Contender final = books.stopped() ? Contender{} : refit(books.shop, t.contender, Effort::final);
  // Of two that explain as well the one with finer rows, which knows its intervals.
  const bool as_good = final.ok && final.error_of.evidence() <= t.contender.error_of.evidence() + rules::tie;
  t.finished = as_good ? std::move(final) : t.contender;
  const auto why = why_implausible(*t.effect, t.laws[t.law], *t.finished, t.excitation);
  if (why.empty()) return true;
  t.admitted = false;
  t.reason = "fitted to its end: " + why;
  return false;
}

void claim(Books& books, int step, std::vector<Tried>& tried, std::size_t winner, const std::vector<int>& ties,
           double progress) {
  Tried& w = tried[winner];
  books.progress("intervals of " + w.effect->id, progress);
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
  books.d.steps.push_back(std::move(found));
}

}  // namespace hysteron
