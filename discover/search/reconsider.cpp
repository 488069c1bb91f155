// Decides whether a set of effects holds once it stands together. Greedy search takes a look-alike where the right one
// was masked, and what a later effect explains better stays in from before.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "discover/models/parts.h"
#include "discover/search/members.h"

namespace hysteron {
namespace {

/// Laws by which a look-alike is tried in place of a member: the simplest, those that refine none, and the one that is
/// called as the member's is (two curves of order 5).
std::vector<Law> laws_to_try(const Effect& effect, const Excitation& at, const std::string& like) {
  auto laws = effect.laws(at);
  if (!laws.empty())
    laws.erase(std::remove_if(laws.begin() + 1, laws.end(), [&](const Law& l) { return !l.apart && l.name != like; }),
               laws.end());
  return laws;
}

/// By member: does it share an output with one that `before` does not have, by way of others perhaps.
std::vector<bool> beside_new_ones(const SearchState& state, const CandidateModel& before) {
  const auto members = members_of(state.current), known = members_of(before);
  const auto is_new = [&](const Member& m) {
    return std::none_of(known.begin(), known.end(), [&](const Member& k) {
      return k.effect == m.effect && k.law == m.law && k.place.where() == m.place.where();
    });
  };
  std::vector<bool> beside(members.size(), false);
  for (const auto& part : parts_of(state.current, state.context.free_paths)) {
    bool any = false;
    for (std::size_t i = 0; i < members.size(); ++i) any = any || (part.has(i) && is_new(members[i]));
    for (std::size_t i = 0; any && i < members.size(); ++i)
      if (part.has(i)) beside[i] = true;
  }
  return beside;
}

/// Who is asked whether the others have made it needless, or a look-alike does better.
struct Asked {
  bool last = false;                       ///< it was taken beside the others, unless all came at once
  const CandidateModel* before = nullptr;  ///< see reconsider()
};

/// What is left without each member that is asked.
using Rests = std::vector<std::optional<CandidateModel>>;
Rests rests_of(const SearchState& state, double progress, const Asked& asked) {
  Rests rests(state.current.placed.size() - (asked.last ? 0 : 1));
  const auto beside = asked.before != nullptr ? beside_new_ones(state, *asked.before)
                                              : std::vector<bool>(state.current.placed.size(), true);
  state.side_by_side(rests.size(), [&](std::size_t i, const FitContext& context) {
    if (!beside[i]) return false;
    state.progress("without " + state.current.placed[i].effect->id, progress);
    rests[i] = rest_of(state, context, i);
    return false;
  });
  return rests;
}

/// The set without one that the others have made needless.
const CandidateModel* without_a_needless_one(const SearchState& state, const Rests& rests) {
  for (std::size_t i = 0; i < rests.size(); ++i)
    if (rests[i] && is_needless(state, *state.current.placed[i].effect, *rests[i])) return &*rests[i];
  return nullptr;
}

/// A law that finds the zero anew, and with its weights the gain, may have stood for these alone; one that holds
/// another effect's besides its own, for that one alone.
bool may_stand_for(const SearchState& state, const PlacedEffect& member, const Effect& e) {
  return look_alike(*member.effect, e) || (member.effect->moves_zero && e.straight) ||
         (member.effect != &e && could_hold(state, member.law, e));
}

/// `other` has a gain and a zero alone in place of the member, which holds these besides its own and takes no more.
bool is_all_of_it(const SearchState& state, const CandidateModel& rest, const Effect& member, const Effect& e,
                  const CandidateModel& other) {
  return member.moves_zero && e.straight &&
         rest.error_of.evidence_validate - other.error_of.evidence_validate > rules::claim_fall &&
         !more_than_a_line(member, other, state.current.error_of, left_by_laws_of(state, other));
}

/// `rest` with a look-alike of a member in its place: one for which the recordings speak, or those that are as good.
struct InPlace {
  std::optional<CandidateModel> better;
  std::vector<TriedEffect> as_good;
};

bool is_as_good(const SearchState& state, const TriedEffect& t) {
  return t.candidate.tie_score() - state.current.tie_score() < rules::tie;
}

/// It came by one law, its simplest most often: what stands is refined before further effects are asked for.
CandidateModel refined(const SearchState& state, TriedEffect t) {
  if (t.candidate.error_of.over_floor() <= rules::floor_gate) return std::move(t.candidate);
  const std::string by = t.laws.front().name;
  t.laws = t.effect->laws(t.excitation);
  const auto same = std::find_if(t.laws.begin(), t.laws.end(), [&](const Law& law) { return law.name == by; });
  if (same == t.laws.end()) return std::move(t.candidate);
  t.law = static_cast<std::size_t>(same - t.laws.begin());
  refine(state, state.context, t);
  return std::move(t.candidate);
}

/// Who `may` stand in place of the member, each by its laws, fitted; those that are themselves are admitted. Ends with
/// the first one for which `enough` holds.
std::vector<TriedEffect> fitted_in_place(
    const SearchState& state, const CandidateModel& rest, const PlacedEffect& m, double progress,
    const std::function<bool(const Effect&)>& may,
    const std::function<bool(const TriedEffect&)>& enough = [](const TriedEffect&) { return false; }) {
  const auto list = choices_on(state, rest, may,
                               [&](const Effect& e, const Excitation& at) { return laws_to_try(e, at, m.law.name); });
  std::vector<TriedEffect> fitted(list.size());
  const std::size_t last = state.side_by_side(list.size(), [&](std::size_t i, const FitContext& context) {
    const auto& [effect, law, place, at] = list[i];
    state.progress(fmt::format("{} in place of {}", effect->id, m.effect->id), progress);
    TriedEffect& t = fitted[i];
    t.effect = effect;
    t.place = place;
    t.excitation = at;
    t.laws = {law};
    t.candidate = with_effect(context, rest, *effect, law, place, at, Effort::full);
    t.admitted = t.candidate.ok && why_implausible(*effect, law, t.candidate, at).empty();
    return t.admitted && enough(t);
  });
  fitted.resize(std::min(fitted.size(), last + 1));
  return fitted;
}

/// Does this effect stand on another axis than the member?
bool stands_on_another_axis(const SearchState& state, const PlacedEffect& member, const std::string& id) {
  const auto own = measured_moved(state, state.current, member.place.moves_from());
  const auto is_own = [&](int output) { return std::find(own.begin(), own.end(), output) != own.end(); };
  const auto& standing = state.current.placed;
  return std::any_of(standing.begin(), standing.end(), [&](const PlacedEffect& s) {
    if (s.effect->id != id) return false;
    const auto moved = measured_moved(state, state.current, s.place.moves_from());
    return std::none_of(moved.begin(), moved.end(), is_own);
  });
}

}  // namespace

bool may_leave(const SearchState& state, const PlacedEffect& member, const TriedEffect& t) {
  return !stands_on_another_axis(state, member, member.effect->id) ||
         stands_on_another_axis(state, member, t.effect->id) ||
         t.candidate.error_of.nrmse_validate < state.current.error_of.nrmse_validate;
}

bool is_needless(const SearchState& state, const Effect& member, const CandidateModel& rest) {
  const double given_back = rest.error_of.evidence_validate - state.current.error_of.evidence_validate;
  if (given_back < rules::claim_fall && rest.score() < state.current.score()) return true;
  // Who could describe it besides, has: that another one does without it says nothing.
  const auto describes = [&](const PlacedEffect& s) { return could_hold(state, s.law, member); };
  if (std::any_of(rest.placed.begin(), rest.placed.end(), describes)) return false;
  return !more_than_laws_leave(member, rest, state.current.error_of, left_by_laws_of(state, rest));
}

namespace {

/// `may`: who is tried.
InPlace in_place_of(const SearchState& state, const CandidateModel& rest, const PlacedEffect& m, double progress,
                    const std::function<bool(const Effect&)>& may) {
  const auto is_better = [&](const TriedEffect& t) {
    return (t.candidate.score() < state.current.score() - rules::exchange ||
            is_all_of_it(state, rest, *m.effect, *t.effect, t.candidate)) &&
           may_leave(state, m, t);
  };
  auto fitted = fitted_in_place(state, rest, m, progress, may, is_better);
  InPlace found;
  if (!fitted.empty() && fitted.back().admitted && is_better(fitted.back())) {
    found.better = refined(state, std::move(fitted.back()));
    return found;
  }
  std::erase_if(fitted, [&](const TriedEffect& t) { return !t.admitted || !is_as_good(state, t); });
  found.as_good = std::move(fitted);
  return found;
}

bool scores_less(const TriedEffect& a, const TriedEffect& b) {
  return a.candidate.tie_score() < b.candidate.tie_score();
}

/// The step in which the member is told.
std::vector<FoundStep>::iterator step_of(SearchState& state, const Member& member) {
  return std::find_if(state.d.steps.begin(), state.d.steps.end(), [&](const FoundStep& s) {
    return s.winner.effect == member.effect->id && s.winner.place == member.place.where();
  });
}

/// What is as good in place of a member becomes a tie of its step, by name once.
void tell_ties(SearchState& state, const CandidateModel& rest, const Member& member,
               std::vector<TriedEffect>& as_good) {
  const auto step = step_of(state, member);
  if (as_good.empty() || step == state.d.steps.end() || !step->ties.empty()) return;
  auto winner = tried_again(state, state.context, rest, member);
  if (!winner) return;
  std::sort(as_good.begin(), as_good.end(), scores_less);
  for (auto& t : as_good) {
    const auto same = [&](const Candidate& c) { return c.effect == t.effect->id; };
    if (same(step->winner) || std::any_of(step->ties.begin(), step->ties.end(), same)) continue;
    judge(*state.evidence, t, rest, left_by_laws_of(state, rest));
    add_tie(state, step->winner.step, *step, *winner, t);
  }
}

/// Effects that the recordings could not tell from this one in its step.
std::vector<std::string> ties_of_step(SearchState& state, const Member& member) {
  std::vector<std::string> ids;
  const auto step = step_of(state, member);
  if (step != state.d.steps.end())
    for (const auto& tie : step->ties) ids.push_back(tie.effect);
  return ids;
}

/// The best of these effects in place of the member, if it explains as much, or in the outputs' units more: laws that
/// are not exact are no ties by chi2 alone.
std::optional<TriedEffect> as_good_as(const SearchState& state, const CandidateModel& rest, const PlacedEffect& m,
                                      const std::vector<std::string>& ids, double progress) {
  auto fitted = fitted_in_place(state, rest, m, progress,
                                [&](const Effect& e) { return std::find(ids.begin(), ids.end(), e.id) != ids.end(); });
  std::erase_if(fitted, [](const TriedEffect& t) { return !t.admitted; });
  const auto best = std::min_element(fitted.begin(), fitted.end(), scores_less);
  if (best == fitted.end()) return std::nullopt;
  const bool explains_more = best->candidate.error_of.nrmse_validate < state.current.error_of.nrmse_validate;
  if (!explains_more && !is_as_good(state, *best)) return std::nullopt;
  return std::move(*best);
}

/// Axes are built alike: a member that could not be told from an effect which stands on another axis since then is that
/// one, and the member becomes its tie.
void as_on_later_axes(SearchState& state, double progress) {
  if (state.base_model->outputs().size() < 2) return;
  const auto standing = state.current.placed;
  const auto members = members_of(state.current);
  for (std::size_t i = 0; i < standing.size() && !state.stopped(); ++i) {
    auto ids = ties_of_step(state, members[i]);
    if (stands_on_another_axis(state, standing[i], standing[i].effect->id)) continue;
    std::erase_if(ids, [&](const std::string& id) { return !stands_on_another_axis(state, standing[i], id); });
    if (ids.empty()) continue;
    const auto rest = rest_of(state, state.context, i);
    if (!rest) continue;
    auto alike = as_good_as(state, *rest, standing[i], ids, progress);
    if (!alike) continue;
    const CandidateModel set = refined(state, std::move(*alike));
    if (!tell_again(state, set)) continue;
    if (auto was = tried_again(state, state.context, *rest, members[i])) {
      std::vector<TriedEffect> rivals;
      rivals.push_back(std::move(*was));
      tell_ties(state, *rest, members_of(set).back(), rivals);
    }
    return;  // the members stand in another order now
  }
}

}  // namespace

void reconsider(SearchState& state, double progress, Came came, const CandidateModel* before) {
  as_on_later_axes(state, progress);
  const bool all_at_once = came == Came::at_once;
  const Asked asked{all_at_once, before};
  Rests rests = rests_of(state, progress, asked);
  if (const CandidateModel* rest = without_a_needless_one(state, rests); rest != nullptr && tell_again(state, *rest))
    rests = rests_of(state, progress, asked);
  const auto members = members_of(state.current);
  const auto standing = state.current.placed;
  for (std::size_t i = 0; i < rests.size() && !state.stopped(); ++i) {
    if (!rests[i]) continue;
    auto in_place = in_place_of(state, *rests[i], standing[i], progress,
                                [&](const Effect& e) { return may_stand_for(state, standing[i], e); });
    if (in_place.better && tell_again(state, *in_place.better)) return;  // the members stand in another order now
    if (all_at_once) tell_ties(state, *rests[i], members[i], in_place.as_good);
  }
}

namespace {

/// The member on the rest by the law that fits best of those that it does not have, at its place.
std::optional<CandidateModel> by_another_law(const SearchState& state, const CandidateModel& rest,
                                             const PlacedEffect& member, double progress) {
  const auto list = choices_on(
      state, rest, [&](const Effect& e) { return &e == member.effect; },
      [&](const Effect& e, const Excitation& at) {
        auto laws = e.laws(at);
        std::erase_if(laws, [&](const Law& law) { return law.name == member.law.name; });
        return laws;
      });
  std::vector<CandidateModel> fitted(list.size());
  state.side_by_side(list.size(), [&](std::size_t i, const FitContext& context) {
    const auto& [effect, law, place, at] = list[i];
    if (place.kind != member.place.kind || place.where() != member.place.where()) return false;
    state.progress(fmt::format("{} beside the others: {}", effect->id, law.name), progress);
    fitted[i] = with_effect(context, rest, *effect, law, place, at, Effort::full);
    fitted[i].ok = fitted[i].ok && why_implausible(*effect, law, fitted[i], at).empty();
    return false;
  });
  std::optional<CandidateModel> best;
  for (auto& c : fitted)
    if (c.ok && (!best || c.score() < best->score())) best = std::move(c);
  return best;
}

}  // namespace

bool refine_what_stands(SearchState& state, double progress) {
  const auto standing = state.current.placed;
  for (std::size_t i = 0; i < standing.size() && standing.size() > 1 && !state.stopped(); ++i) {
    const auto rest = rest_of(state, state.context, i);
    if (!rest) continue;
    const auto richer = by_another_law(state, *rest, standing[i], progress);
    if (!richer) continue;
    const double others_say = state.current.error_of.evidence_validate - richer->error_of.evidence_validate;
    // Where nobody states the noise, what is slow is taken for some, and chi2 falls while the error grows.
    if (!(richer->error_of.nrmse_validate < state.current.error_of.nrmse_validate)) continue;
    if (others_say > rules::exchange && richer->score() < state.current.score() - rules::exchange &&
        tell_again(state, *richer)) {
      reconsider(state, progress, Came::at_once);
      return true;
    }
  }
  return false;
}

namespace {

/// Does the rival of a step explain the recordings as well as the member beside all the others, by its simplest law or
/// that by which it was tied?
bool is_tied_beside(const SearchState& state, const CandidateModel& rest, const std::string& rival,
                    const std::string& tied_by, double progress) {
  const Effect& effect = state.effects.get(rival);
  const auto list = choices_on(
      state, rest, [&](const Effect& e) { return &e == &effect; },
      [&](const Effect& e, const Excitation& at) { return laws_to_try(e, at, tied_by); });
  std::vector<char> as_good(list.size(), 0);
  state.side_by_side(list.size(), [&](std::size_t i, const FitContext& context) {
    const auto& [e, law, place, at] = list[i];
    state.progress(fmt::format("is it {} beside what came later", e->id), progress);
    CandidateModel c = with_effect(context, rest, *e, law, place, at, Effort::full);
    if (c.ok) c = refit(context, c, Effort::final);
    if (!c.ok) return false;
    c.error_of = state.evidence->error(c.prediction);
    as_good[i] = c.tie_score() - state.current.tie_score() < rules::tie && why_implausible(*e, law, c, at).empty();
    return false;
  });
  return std::find(as_good.begin(), as_good.end(), 1) != as_good.end();
}

}  // namespace

void ties_beside_what_came_later(SearchState& state, double progress) {
  auto& steps = state.d.steps;
  if (steps.size() < 2 || state.current.error_of.over_floor() > rules::floor_gate) return;
  const auto members = members_of(state.current);
  for (std::size_t i = 0; i < members.size() && !state.stopped(); ++i) {
    const auto step = step_of(state, members[i]);
    if (step == steps.end()) continue;
    auto& same = step->winner.same_effects;
    if (step->ties.empty() && same.empty()) continue;
    const auto rest = rest_of(state, state.context, i);
    if (!rest) continue;
    std::erase_if(step->ties,
                  [&](const Candidate& c) { return !is_tied_beside(state, *rest, c.effect, c.law, progress); });
    // In a linear chain its place is of no matter; it is where a gap or a curve stands in it by now.
    std::erase_if(same,
                  [&](const std::string& id) { return !is_tied_beside(state, *rest, id, step->winner.law, progress); });
    if (same.empty()) step->winner.same_places.clear();
    if (step->ties.empty()) {
      step->experiment.reset();
      step->menu = {};
      step->experiment_would_tell = false;
    }
  }
}

void exchange_for_what_they_hold(SearchState& state, double progress) {
  for (std::size_t i = 0; i < state.current.placed.size() && !state.stopped(); ++i) {
    const PlacedEffect member = state.current.placed[i];
    if (member.law.holds.empty() || state.current.placed.size() == 1) continue;
    const auto rest = rest_of(state, state.context, i);
    if (!rest) continue;
    const auto in_place = in_place_of(state, *rest, member, progress, [&](const Effect& e) {
      return member.effect != &e && could_hold(state, member.law, e);
    });
    if (!in_place.better || !tell_again(state, *in_place.better)) continue;
    return reconsider(state, progress,
                      Came::at_once);  // the others were found beside the slow law: now they cost little
  }
}

}  // namespace hysteron
