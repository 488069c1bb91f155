// Decides which candidates explain the recordings as well as the best one. What would tell them apart:
// tie_experiment.cpp.
#include <algorithm>
#include <cmath>

#include "discover/placement/excitation.h"
#include "discover/search/search_state.h"
#include "discover/wiring/wiring.h"

namespace hysteron {
namespace {

/// With few recordings a spare gain tells look-alikes apart that are none: each gets one, and an offset, before the
/// comparison.
double tie_score(SearchState& state, const TriedEffect& t, bool few) {
  if (!few || t.effect->straight) return t.candidate.tie_score();
  const Effect* calibration = state.effects.find("calibration");
  if (calibration == nullptr) return t.candidate.tie_score();
  const auto places = places_of(*calibration, t.candidate.diagram, state.registry);
  if (places.empty()) return t.candidate.tie_score();
  const auto at = circumstances_at(t.candidate.diagram, state.registry, *state.data, places.front(),
                                   free_anyway(state.context, t.candidate));
  if (!calibration->unseen(at).empty()) return t.candidate.tie_score();
  const CandidateModel free = with_effect(state.context, t.candidate, *calibration, calibration->laws(at).front(),
                                          places.front(), at, Effort::full);
  return free.ok ? std::min(free.tie_score(), t.candidate.tie_score()) : t.candidate.tie_score();
}

}  // namespace

bool is_the_winner_and_more(const SearchState& state, const TriedEffect& t, const Effect& winner) {
  const auto& contained = t.effect->contains;
  return std::find(contained.begin(), contained.end(), winner.id) != contained.end() ||
         could_hold(state, t.laws[t.law], winner);
}

void sharpen(SearchState& state, TriedEffect& t) {
  if (t.sharp || state.stopped()) return;
  t.sharp = true;
  CandidateModel finer = refit(state.context, t.candidate, Effort::final);
  if (!finer.ok) return;
  finer.error_of = state.evidence->error(finer.prediction);
  t.candidate = std::move(finer);
  // Where it goes on to, it may no longer be itself.
  if (const auto why = why_implausible(*t.effect, t.laws[t.law], t.candidate, t.excitation); !why.empty()) {
    t.admitted = false;
    t.reason = why;
  }
}

/// Where structure is left, neither law is right, and a difference counts only if it is there wherever one looks, or
/// if the rival leaves far more.
bool as_imperfect(const SearchState& state, const TriedEffect& rival, const TriedEffect& winner) {
  const double left = winner.candidate.error_of.over_floor() - 1, by_rival = rival.candidate.error_of.over_floor() - 1;
  if (left + 1 <= rules::floor_gate || by_rival > rules::far_more * left) return false;
  return std::abs(vuong(state.evidence->pieces(rival.candidate.prediction),
                        state.evidence->pieces(winner.candidate.prediction))) < rules::pieces_tell;
}

double lost_by_the_fit(const TriedEffect& t) {
  if (!(t.fall_train > rules::claim_fall)) return 0;
  const double of_a_number = std::max(0.0, t.fall_validate / t.fall_train - rules::usual_split);
  return std::min(static_cast<double>(own_values(t).size()) * of_a_number, rules::lost_at_most * t.fall_validate);
}

std::vector<int> ties_of(SearchState& state, const std::vector<TriedEffect>& tried, std::size_t winner) {
  const bool few = static_cast<int>(state.evidence->recordings().size()) <= rules::few_recordings && !state.stopped();
  const TriedEffect& w = tried[winner];
  const bool spare_gain = few && !w.effect->straight;  // beside that one the spare gain is the winner itself
  std::vector<int> ties;
  double own = w.candidate.tie_score();
  bool freed = false;
  for (const std::size_t i : ranking(tried)) {
    const TriedEffect& t = tried[i];
    if (i == winner || t.effect->id == w.effect->id || !t.admitted) continue;
    if (is_the_winner_and_more(state, t, *w.effect)) continue;
    const double behind = t.candidate.tie_score() - w.candidate.tie_score();
    bool tied = behind < rules::tie;
    if (!tied && look_alike(*t.effect, *w.effect))
      tied = behind < rules::tie + std::max(lost_by_the_fit(t), lost_by_the_fit(w));
    if (!tied && spare_gain && look_alike(*t.effect, *w.effect)) {
      if (!freed) own = tie_score(state, w, true);
      freed = true;
      tied = tie_score(state, t, true) - own < rules::tie;
    }
    tied = tied || (look_alike(*t.effect, *w.effect) && as_imperfect(state, t, w));
    if (tied) ties.push_back(static_cast<int>(i));
  }
  return ties;
}

int plainer_first(const std::vector<TriedEffect>& tried, int winner) {
  const TriedEffect& w = tried[static_cast<std::size_t>(winner)];
  // Several sensors that are wrong at once are not plainer than a device that ages.
  const auto elsewhere = [&](const TriedEffect& t) {
    return t.effect == w.effect && t.admitted && t.outputs != w.outputs;
  };
  const auto& plainer = w.effect->plainer;
  if (std::any_of(tried.begin(), tried.end(), elsewhere)) return winner;
  for (const std::size_t i : ranking(tried)) {
    const TriedEffect& t = tried[i];
    if (t.admitted && t.outputs == w.outputs &&
        std::find(plainer.begin(), plainer.end(), t.effect->id) != plainer.end() &&
        t.candidate.tie_score() - w.candidate.tie_score() < rules::tie)
      return static_cast<int>(i);
  }
  return winner;
}

void as_on_another_axis(const SearchState& state, std::vector<TriedEffect>& tried, int& winner,
                        std::vector<int>& ties) {
  const auto stands = [&](int i) {
    const std::string& id = tried[static_cast<std::size_t>(i)].effect->id;
    return std::any_of(state.current.placed.begin(), state.current.placed.end(),
                       [&](const PlacedEffect& s) { return s.effect->id == id; });
  };
  if (stands(winner)) return;
  const auto built_alike = std::find_if(ties.begin(), ties.end(), [&](int i) {
    return stands(i) && stays_itself(state, tried[static_cast<std::size_t>(i)]);
  });
  if (built_alike != ties.end()) std::swap(winner, *built_alike);
}

void sharpen_rivals(SearchState& state, std::vector<TriedEffect>& tried, std::size_t winner) {
  TriedEffect& w = tried[winner];
  const double reach = rules::tie + blur(w.candidate);
  const double best = w.candidate.tie_score();
  bool sharp = false;
  for (auto& t : tried) {
    if (&t == &w || !t.admitted || t.effect->id == w.effect->id || !look_alike(*t.effect, *w.effect)) continue;
    const double gap = t.candidate.tie_score() - best;
    if (gap < rules::tie || gap > reach) continue;
    if (!sharp) sharpen(state, w);
    sharp = true;
    sharpen(state, t);
  }
}

}  // namespace hysteron
