// Decides whether an effect that was found on the way to one output acts on the way to the others: axes are built alike
// and stand in one room, and one that is looked for on each axis in turn uses up the steps that others need.
#include <algorithm>
#include <cmath>
#include <optional>

#include "discover/books.h"

namespace hysteron {
namespace {

const Effect* standing_effect(const Books& books, const std::string& id) {
  for (const auto& s : books.current.standing)
    if (s.effect->id == id) return s.effect;
  return nullptr;
}

/// The law, begun where the effect stands: one room has one frequency of its mains.
Law as_found(const Books& books, const Effect& effect, Law law) {
  for (std::size_t i = 0; i < books.current.standing.size(); ++i) {
    if (books.current.standing[i].effect != &effect) continue;
    for (const auto& p : parameters_of(books.current, static_cast<int>(i)))
      for (auto& q : law.free)
        if (p.estimate != nullptr && !p.estimate->linear && q.path == p.law->path) q.scan = {p.estimate->used, q.start};
    return law;
  }
  return law;
}

/// Fall of the score by a candidate alone.
double gain_of(const Books& books, const Tried& t) {
  const auto values = static_cast<double>(own_values(t).size());
  return t.fall_train + t.fall_validate - values * std::log(std::max(books.current.error_of.witnesses, 2.0));
}

/// Who else was tried on the same outputs and explains them better; nullptr if nobody does.
const Tried* better_there(const Books& books, const Tried& t, const std::vector<Tried>& others) {
  for (const auto& o : others)
    if (o.admitted && o.effect->family != t.effect->family && o.outputs == t.outputs &&
        gain_of(books, o) > gain_of(books, t) + rules::exchange)
      return &o;
  return nullptr;
}

/// The step that found the effect, if its rivals explain these outputs too.
std::optional<FoundStep> alike_on(const Books& books, const Tried& t, const std::vector<Tried>& others) {
  for (const auto& s : books.d.steps) {
    if (s.winner.effect != t.effect->id) continue;
    FoundStep same = s;
    std::erase_if(same.ties, [&](const Candidate& tie) {
      return std::none_of(others.begin(), others.end(), [&](const Tried& o) {
        return o.effect->id == tie.effect && o.admitted && o.outputs == t.outputs;
      });
    });
    if (same.ties.empty()) return std::nullopt;
    return same;
  }
  return std::nullopt;
}

}  // namespace

void on_other_outputs(Books& books, const std::string& id, const std::vector<Tried>& others_tried, double bar) {
  if (books.base_model->outputs().size() < 2) return;
  while (!books.stopped()) {
    const Effect* effect = standing_effect(books, id);
    if (effect == nullptr) return;
    const auto others = outputs_without(books, effect->family);
    if (others.empty()) return;
    const int step = static_cast<int>(books.d.steps.size()) + 1;
    auto tried = list_candidates(books, step, others, {effect});
    for (auto& t : tried) {
      books.progress(id + " at " + t.place.at, bar);
      t.contender = with_effect(books.shop, books.current, *effect, as_found(books, *effect, t.laws.front()), t.place,
                                t.circumstances, Effort::full);
      books.d.model_runs += t.contender.runs;
    }
    join_twins(tried);
    compare_all(books, tried, As::first);
    enrich(books, tried, step, As::first, bar);
    for (auto& t : tried)
      if (const Tried* other = t.admitted ? better_there(books, t, others_tried) : nullptr; other != nullptr) {
        t.admitted = false;
        t.reason = other->effect->id + " explains that output better";
      }
    const int winner = best_admitted(tried);
    if (winner >= 0) {
      const auto index = static_cast<std::size_t>(winner);
      const auto alike = alike_on(books, tried[index], others_tried);
      claim(books, step, tried, index, {}, bar, alike ? &*alike : nullptr);
    }
    keep_candidates(books, tried, step, winner, {});
    if (winner < 0) return;
  }
}

}  // namespace hysteron
