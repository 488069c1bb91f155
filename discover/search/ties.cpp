// Decides which candidates explain the recordings as well as the best one. What would tell them apart:
// tie_experiment.cpp.
#include <algorithm>
#include <cmath>

#include "discover/placement/excitation.h"
#include "discover/search/books.h"
#include "discover/wiring/wiring.h"

namespace hysteron {
namespace {

/// With few recordings a spare gain tells look-alikes apart that are none: each gets one, and an offset, before the
/// comparison.
double tie_score(Books& books, const Tried& t, bool few) {
  if (!few || t.effect->straight) return t.contender.tie_score();
  const Effect* calibration = books.effects.find("calibration");
  if (calibration == nullptr) return t.contender.tie_score();
  const auto places = places_of(*calibration, t.contender.diagram, books.registry);
  if (places.empty()) return t.contender.tie_score();
  const auto at = circumstances_at(t.contender.diagram, books.registry, *books.data, places.front(),
                                   free_anyway(books.shop, t.contender));
  if (!calibration->unseen(at).empty()) return t.contender.tie_score();
  const Contender free = with_effect(books.shop, t.contender, *calibration, calibration->laws(at).front(),
                                     places.front(), at, Effort::full);
  return free.ok ? std::min(free.tie_score(), t.contender.tie_score()) : t.contender.tie_score();
}

}  // namespace

bool is_the_winner_and_more(const Books& books, const Tried& t, const Effect& winner) {
  const auto& contained = t.effect->contains;
  return std::find(contained.begin(), contained.end(), winner.id) != contained.end() ||
         could_hold(books, t.laws[t.law], winner);
}

void sharpen(Books& books, Tried& t) {
  if (t.sharp || books.stopped()) return;
  t.sharp = true;
  Contender finer = refit(books.shop, t.contender, Effort::final);
  if (!finer.ok) return;
  finer.error_of = books.evidence->error(finer.prediction);
  t.contender = std::move(finer);
  // Where it goes on to, it may no longer be itself.
  if (const auto why = why_implausible(*t.effect, t.laws[t.law], t.contender, t.excitation); !why.empty()) {
    t.admitted = false;
    t.reason = why;
  }
}

/// Where structure is left, neither law is right, and a difference counts only if it is there wherever one looks, or
/// if the rival leaves far more.
bool as_imperfect(const Books& books, const Tried& rival, const Tried& winner) {
  const double left = winner.contender.error_of.over_floor() - 1, by_rival = rival.contender.error_of.over_floor() - 1;
  if (left + 1 <= rules::floor_gate || by_rival > rules::far_more * left) return false;
  return std::abs(vuong(books.evidence->pieces(rival.contender.prediction),
                        books.evidence->pieces(winner.contender.prediction))) < rules::pieces_tell;
}

double lost_by_the_fit(const Tried& t) {
  if (!(t.fall_train > rules::claim_fall)) return 0;
  const double of_a_number = std::max(0.0, t.fall_validate / t.fall_train - rules::usual_split);
  return std::min(static_cast<double>(own_values(t).size()) * of_a_number, rules::lost_at_most * t.fall_validate);
}

std::vector<int> ties_of(Books& books, const std::vector<Tried>& tried, std::size_t winner) {
  const bool few = static_cast<int>(books.evidence->recordings().size()) <= rules::few_recordings && !books.stopped();
  const Tried& w = tried[winner];
  const bool spare_gain = few && !w.effect->straight;  // beside that one the spare gain is the winner itself
  std::vector<int> ties;
  double own = w.contender.tie_score();
  bool freed = false;
  for (const std::size_t i : ranking(tried)) {
    const Tried& t = tried[i];
    if (i == winner || t.effect->id == w.effect->id || !t.admitted) continue;
    if (is_the_winner_and_more(books, t, *w.effect)) continue;
    const double behind = t.contender.tie_score() - w.contender.tie_score();
    bool tied = behind < rules::tie;
    if (!tied && look_alike(*t.effect, *w.effect))
      tied = behind < rules::tie + std::max(lost_by_the_fit(t), lost_by_the_fit(w));
    if (!tied && spare_gain && look_alike(*t.effect, *w.effect)) {
      if (!freed) own = tie_score(books, w, true);
      freed = true;
      tied = tie_score(books, t, true) - own < rules::tie;
    }
    tied = tied || (look_alike(*t.effect, *w.effect) && as_imperfect(books, t, w));
    if (tied) ties.push_back(static_cast<int>(i));
  }
  return ties;
}

int plainer_first(const std::vector<Tried>& tried, int winner) {
  const Tried& w = tried[static_cast<std::size_t>(winner)];
  // Several sensors that are wrong at once are not plainer than a device that ages.
  const auto elsewhere = [&](const Tried& t) { return t.effect == w.effect && t.admitted && t.outputs != w.outputs; };
  const auto& plainer = w.effect->plainer;
  if (std::any_of(tried.begin(), tried.end(), elsewhere)) return winner;
  for (const std::size_t i : ranking(tried)) {
    const Tried& t = tried[i];
    if (t.admitted && t.outputs == w.outputs &&
        std::find(plainer.begin(), plainer.end(), t.effect->id) != plainer.end() &&
        t.contender.tie_score() - w.contender.tie_score() < rules::tie)
      return static_cast<int>(i);
  }
  return winner;
}

void as_on_another_axis(const Books& books, std::vector<Tried>& tried, int& winner, std::vector<int>& ties) {
  const auto stands = [&](int i) {
    const std::string& id = tried[static_cast<std::size_t>(i)].effect->id;
    return std::any_of(books.current.standing.begin(), books.current.standing.end(),
                       [&](const Standing& s) { return s.effect->id == id; });
  };
  if (stands(winner)) return;
  const auto built_alike = std::find_if(ties.begin(), ties.end(), [&](int i) {
    return stands(i) && stays_itself(books, tried[static_cast<std::size_t>(i)]);
  });
  if (built_alike != ties.end()) std::swap(winner, *built_alike);
}

void sharpen_rivals(Books& books, std::vector<Tried>& tried, std::size_t winner) {
  Tried& w = tried[winner];
  const double reach = rules::tie + blur(w.contender);
  const double best = w.contender.tie_score();
  bool sharp = false;
  for (auto& t : tried) {
    if (&t == &w || !t.admitted || t.effect->id == w.effect->id || !look_alike(*t.effect, *w.effect)) continue;
    const double gap = t.contender.tie_score() - best;
    if (gap < rules::tie || gap > reach) continue;
    if (!sharp) sharpen(books, w);
    sharp = true;
    sharpen(books, t);
  }
}

}  // namespace hysteron
