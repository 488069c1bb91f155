#include "discover/search/members.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace hysteron {
namespace {

std::optional<Tried> tried_at(const Books& books, const Workshop& shop, const Contender& model, const Member& m,
                              const Place& place, Line line) {
  Tried t;
  t.effect = m.effect;
  t.place = place;
  t.excitation = circumstances_on(books, model, {place}).front();
  if (line == Line::held && m.effect->of_the_sensor()) t.excitation.gain_is_free = t.excitation.offset_is_free = true;
  t.laws = m.effect->laws(t.excitation);
  const auto law = std::find_if(t.laws.begin(), t.laws.end(), [&](const Law& l) { return l.name == m.law; });
  if (law == t.laws.end()) return std::nullopt;
  t.law = static_cast<std::size_t>(law - t.laws.begin());
  t.contender = with_effect(shop, model, *t.effect, *law, t.place, t.excitation, Effort::full);
  if (!t.contender.ok) return std::nullopt;
  t.admitted = true;
  return t;
}

/// Which of the members takes most away from the present model, and its index.
std::pair<std::optional<Tried>, std::size_t> largest_of(const Books& books, const std::vector<Member>& members) {
  std::vector<std::optional<Tried>> all(members.size());
  books.side_by_side(members.size(), [&](std::size_t i, const Workshop& shop) {
    all[i] = tried_again(books, shop, books.current, members[i]);
    return false;
  });
  std::pair<std::optional<Tried>, std::size_t> best;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (auto& t = all[i]; t && (!best.first || t->contender.score() < best.first->contender.score()))
      best = {std::move(t), i};
  return best;
}

/// Marks what was claimed before and is no more, and the other way round.
void mark_claimed(Books& books, const std::vector<Member>& before) {
  for (auto& c : books.d.candidates)
    if (c.claimed) c.reason = "taken at first, surpassed by what was found later: " + c.reason;
  for (auto& c : books.d.candidates) c.claimed = false;
  for (const auto& s : books.d.steps) {
    const auto is = [&](const Candidate& c) { return s.winner.effect == c.effect && s.winner.place == c.place; };
    const auto here = std::find_if(books.d.candidates.begin(), books.d.candidates.end(), is);
    if (here == books.d.candidates.end()) continue;
    here->claimed = true;
    here->reason = s.winner.reason;
  }
  for (const auto& m : before)
    if (std::none_of(books.d.steps.begin(), books.d.steps.end(),
                     [&](const FoundStep& s) { return s.winner.effect == m.effect->id; }))
      books.d.data_remarks.push_back(fmt::format(
          "{} was taken at first; beside what came later the recordings do not speak for it", m.effect->id));
}

}  // namespace

std::vector<Member> members_of(const Contender& contender) {
  std::vector<Member> list;
  for (const auto& s : contender.standing) list.push_back({s.effect, s.place, s.law.name});
  return list;
}

std::optional<Tried> tried_again(const Books& books, const Workshop& shop, const Contender& model, const Member& m,
                                 Line line) {
  auto places = places_of(*m.effect, model.diagram, books.registry, books.data.get());
  const auto same = [&](const Place& p) { return p.kind == m.place.kind && p.where() == m.place.where(); };
  if (std::any_of(places.begin(), places.end(), same)) std::erase_if(places, [&](const Place& p) { return !same(p); });
  std::optional<Tried> best;
  for (const auto& place : places) {
    auto t = tried_at(books, shop, model, m, place, line);
    if (t && (!best || t->contender.score() < best->contender.score())) best = std::move(t);
  }
  return best;
}

std::optional<Contender> rest_of(const Books& books, const Workshop& shop, std::size_t i, Line line) {
  const auto members = members_of(books.current);
  Contender rest = books.base;
  const bool calibration = calibrates(books.current.standing[i]) && line == Line::held;
  rest.zero_held = calibration || (books.current.zero_held && line == Line::held);
  for (std::size_t j = 0; j < members.size(); ++j) {
    if (j == i) continue;
    auto t = tried_again(books, shop, rest, members[j], calibration ? Line::held : Line::of_a_curve);
    if (!t) return std::nullopt;
    rest = std::move(t->contender);
  }
  return rest;
}

bool tell_again(Books& books, const Contender& set) {
  const Contender current = books.current;
  const auto steps = books.d.steps;
  const Prediction before = books.before_prediction;
  books.current = books.base;
  books.current.zero_held = set.zero_held;
  // Told from the start, a line is not known before its step.
  books.evidence->known_lines({});
  books.evidence->settle(set.prediction);
  books.before_prediction = {};
  books.d.steps.clear();
  auto left = members_of(set);
  const std::size_t all = left.size();
  while (!left.empty()) {
    auto [t, which] = largest_of(books, left);
    if (!t) break;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(which));
    if (left.empty()) {
      if (set.score() < t->contender.score()) t->contender = set;
      sharpen(books, *t);
    }
    if (!why_implausible(*t->effect, t->laws[t->law], t->contender, t->excitation).empty()) break;
    FoundStep found;
    for (const auto& was : steps)
      if (was.winner.effect == t->effect->id && was.winner.place == t->place.where()) {
        found.ties = was.ties;
        found.experiment = was.experiment;
        found.menu = was.menu;
        found.experiment_would_tell = was.experiment_would_tell;
      }
    take(books, static_cast<int>(books.d.steps.size()) + 1, *t, std::move(found));
  }
  if (books.d.steps.size() == all) {
    mark_claimed(books, members_of(current));
    return true;
  }
  books.current = current;
  books.before_prediction = before;
  books.d.steps = steps;
  books.settle(books.current);
  return false;
}

}  // namespace hysteron
