#include "discover/search/members.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace hysteron {
namespace {

std::optional<TriedEffect> tried_at(const SearchState& state, const FitContext& context, const CandidateModel& model,
                                    const Member& m, const Place& place, Line line) {
  TriedEffect t;
  t.effect = m.effect;
  t.place = place;
  t.excitation = circumstances_on(state, model, {place}).front();
  if (line == Line::held && m.effect->of_the_sensor()) t.excitation.gain_is_free = t.excitation.offset_is_free = true;
  t.laws = m.effect->laws(t.excitation);
  const auto law = std::find_if(t.laws.begin(), t.laws.end(), [&](const Law& l) { return l.name == m.law; });
  if (law == t.laws.end()) return std::nullopt;
  t.law = static_cast<std::size_t>(law - t.laws.begin());
  t.candidate = with_effect(context, model, *t.effect, *law, t.place, t.excitation, Effort::full);
  if (!t.candidate.ok) return std::nullopt;
  t.admitted = true;
  return t;
}

/// Which of the members takes most away from the present model, and its index.
std::pair<std::optional<TriedEffect>, std::size_t> largest_of(const SearchState& state,
                                                              const std::vector<Member>& members) {
  std::vector<std::optional<TriedEffect>> all(members.size());
  state.side_by_side(members.size(), [&](std::size_t i, const FitContext& context) {
    all[i] = tried_again(state, context, state.current, members[i]);
    return false;
  });
  std::pair<std::optional<TriedEffect>, std::size_t> best;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (auto& t = all[i]; t && (!best.first || t->candidate.score() < best.first->candidate.score()))
      best = {std::move(t), i};
  return best;
}

/// Marks what was claimed before and is no more, and the other way round.
void mark_claimed(SearchState& state, const std::vector<Member>& before) {
  for (auto& c : state.d.candidates)
    if (c.claimed) c.reason = "taken at first, surpassed by what was found later: " + c.reason;
  for (auto& c : state.d.candidates) c.claimed = false;
  for (const auto& s : state.d.steps) {
    const auto is = [&](const Candidate& c) { return s.winner.effect == c.effect && s.winner.place == c.place; };
    const auto here = std::find_if(state.d.candidates.begin(), state.d.candidates.end(), is);
    if (here == state.d.candidates.end()) continue;
    here->claimed = true;
    here->reason = s.winner.reason;
  }
  for (const auto& m : before)
    if (std::none_of(state.d.steps.begin(), state.d.steps.end(),
                     [&](const FoundStep& s) { return s.winner.effect == m.effect->id; }))
      state.d.data_remarks.push_back(fmt::format(
          "{} was taken at first; beside what came later the recordings do not speak for it", m.effect->id));
}

}  // namespace

std::vector<Member> members_of(const CandidateModel& candidate) {
  std::vector<Member> list;
  for (const auto& s : candidate.placed) list.push_back({s.effect, s.place, s.law.name});
  return list;
}

std::optional<TriedEffect> tried_again(const SearchState& state, const FitContext& context, const CandidateModel& model,
                                       const Member& m, Line line) {
  auto places = places_of(*m.effect, model.diagram, state.registry, state.data.get());
  const auto same = [&](const Place& p) { return p.kind == m.place.kind && p.where() == m.place.where(); };
  if (std::any_of(places.begin(), places.end(), same)) std::erase_if(places, [&](const Place& p) { return !same(p); });
  std::optional<TriedEffect> best;
  for (const auto& place : places) {
    auto t = tried_at(state, context, model, m, place, line);
    if (t && (!best || t->candidate.score() < best->candidate.score())) best = std::move(t);
  }
  return best;
}

std::optional<CandidateModel> rest_of(const SearchState& state, const FitContext& context, std::size_t i, Line line) {
  const auto members = members_of(state.current);
  CandidateModel rest = state.base;
  const bool calibration = calibrates(state.current.placed[i]) && line == Line::held;
  rest.zero_held = calibration || (state.current.zero_held && line == Line::held);
  for (std::size_t j = 0; j < members.size(); ++j) {
    if (j == i) continue;
    auto t = tried_again(state, context, rest, members[j], calibration ? Line::held : Line::of_a_curve);
    if (!t) return std::nullopt;
    rest = std::move(t->candidate);
  }
  return rest;
}

bool tell_again(SearchState& state, const CandidateModel& set) {
  const CandidateModel current = state.current;
  const auto steps = state.d.steps;
  const Prediction before = state.before_prediction;
  state.current = state.base;
  state.current.zero_held = set.zero_held;
  // Told from the start, a line is not known before its step.
  state.evidence->known_lines({});
  state.evidence->settle(set.prediction);
  state.before_prediction = {};
  state.d.steps.clear();
  auto left = members_of(set);
  const std::size_t all = left.size();
  while (!left.empty()) {
    auto [t, which] = largest_of(state, left);
    if (!t) break;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(which));
    if (left.empty()) {
      if (set.score() < t->candidate.score()) t->candidate = set;
      sharpen(state, *t);
    }
    if (!why_implausible(*t->effect, t->laws[t->law], t->candidate, t->excitation).empty()) break;
    FoundStep found;
    for (const auto& was : steps)
      if (was.winner.effect == t->effect->id && was.winner.place == t->place.where()) {
        found.ties = was.ties;
        found.experiment = was.experiment;
        found.menu = was.menu;
        found.experiment_would_tell = was.experiment_would_tell;
      }
    take(state, static_cast<int>(state.d.steps.size()) + 1, *t, std::move(found));
  }
  if (state.d.steps.size() == all) {
    mark_claimed(state, members_of(current));
    return true;
  }
  state.current = current;
  state.before_prediction = before;
  state.d.steps = steps;
  state.settle(state.current);
  return false;
}

}  // namespace hysteron
