// Decides which candidates explain the recordings as well as the best one, and which experiment would tell them apart.
#include <algorithm>
#include <cmath>

#include "discover/books.h"
#include "discover/circumstances.h"
#include "discover/wiring.h"

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

bool is_of_sensor(const Effect& e) { return e.places == std::vector<std::string>{"measured"} && e.id != "calibration"; }

/// Compiled anew: fitted values stand in the diagram. `motion`: without the last effect where it is the sensor's.
ProgramPointer rival(const Books& books, const Tried& t, bool motion) {
  const Contender& c = t.contender;
  return compile(motion && is_of_sensor(*t.effect) ? remove_effect(c.diagram, c.standing.back().name) : c.diagram,
                 books.registry);
}

}  // namespace

void sharpen(Books& books, Tried& t) {
  if (t.sharp) return;
  t.sharp = true;
  Contender finer = refit(books.shop, t.contender, Effort::final);
  if (!finer.ok) return;
  finer.error_of = books.evidence->error(finer.prediction);
  t.contender = std::move(finer);
  // Where it goes on to, it may no longer be itself.
  if (const auto why = why_implausible(*t.effect, t.laws[t.law], t.contender, t.circumstances); !why.empty()) {
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

std::vector<int> ties_of(Books& books, const std::vector<Tried>& tried, std::size_t winner) {
  const bool few = static_cast<int>(books.evidence->recordings().size()) <= rules::few_recordings;
  const Tried& w = tried[winner];
  const bool spare_gain = few && !w.effect->straight;  // beside that one the spare gain is the winner itself
  std::vector<int> ties;
  double own = w.contender.tie_score();
  bool freed = false;
  for (const std::size_t i : ranking(tried)) {
    const Tried& t = tried[i];
    if (i == winner || t.effect->id == w.effect->id || !t.admitted) continue;
    if (std::find(t.effect->contains.begin(), t.effect->contains.end(), w.effect->id) != t.effect->contains.end())
      continue;
    bool tied = t.contender.tie_score() - w.contender.tie_score() < rules::tie;
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

std::optional<Experiment> experiment_between(Books& books, const Tried& a, const Tried& b) {
  Rivals rivals{rival(books, a, false), rival(books, b, false), {}, {}, {}, {}};
  for (const auto* t : {&a, &b}) {
    if (!t->place.side.empty()) rivals.sides.push_back({t->place.side, t->effect->side});
    for (const auto& l : t->effect->look_alikes)
      if (l.effect == (t == &a ? b : a).effect->id) rivals.preferred.push_back(l.experiment);
  }
  if (is_of_sensor(*a.effect) != is_of_sensor(*b.effect)) {
    rivals.motion_a = rival(books, a, true);
    rivals.motion_b = rival(books, b, true);
  }
  std::vector<bool> free_zero;
  for (int o = 0; o < static_cast<int>(books.base_model->outputs().size()); ++o)
    free_zero.push_back(books.base_model->zero_per_recording(o));
  Device device = device_of(books.base_model->program(), *books.data);
  auto e = separate(rivals, books.base_model->outputs(), device, books.evidence->noise().white(), free_zero);
  // Few recordings of one kind may just have been too slow: the same menu, sampled faster.
  const bool few = static_cast<int>(books.evidence->recordings().size()) <= rules::few_recordings;
  for (int faster = 0; few && faster < 2 && (!e || e->separation <= rules::experiment_tells); ++faster) {
    device.shortest_step /= 8;
    auto again = separate(rivals, books.base_model->outputs(), device, books.evidence->noise().white(), free_zero);
    if (again && (!e || again->separation > e->separation)) e = std::move(again);
  }
  if (e) e->between = a.effect->id + " and " + b.effect->id;
  return e;
}

bool would_tell(const Experiment& e, bool hidden) {
  return e.separation > rules::experiment_tells ||
         (hidden && e.separation * e.separation * e.rows > 2 * rules::claim_fall);
}

}  // namespace hysteron
