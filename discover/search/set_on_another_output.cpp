// Decides whether what was found on the way to one output acts on the way to another one as a set: axes are built alike
// and stand in one room, and what alone is a patch there may explain that output together.
#include <algorithm>
#include <optional>

#include "discover/search/books.h"

namespace hysteron {
namespace {

/// Effects that stand, none of whose family moves this output.
std::vector<const Effect*> missing_on(const Books& books, const std::string& output) {
  std::vector<const Effect*> list;
  for (const auto& s : books.current.standing) {
    if (s.effect->side == Side::other_axis || std::find(list.begin(), list.end(), s.effect) != list.end()) continue;
    const auto without = outputs_without(books, s.effect->family);
    if (std::find(without.begin(), without.end(), output) != without.end()) list.push_back(s.effect);
  }
  return list;
}

/// `model` with the effect at the best place on the way to this output alone, by the laws by which it stands elsewhere.
std::optional<Tried> with_effect_on(const Books& books, const Contender& model, const Effect& effect,
                                    const std::string& output, double progress) {
  auto list = choices_on(
      books, model, [&](const Effect& e) { return &e == &effect; },
      [&](const Effect& e, const Excitation& at) { return laws_as_found(books, e, e.laws(at)); });
  std::erase_if(list, [&](const Choice& c) {
    const auto moved = measured_moved(books, model, c.place.moves_from());
    return moved.size() != 1 || books.base_model->outputs()[static_cast<std::size_t>(moved.front())] != output;
  });
  std::vector<Tried> fitted(list.size());
  books.side_by_side(list.size(), [&](std::size_t i, const Workshop& shop) {
    Tried& t = fitted[i];
    books.progress(effect.id + ", with what stands on another axis, at " + list[i].place.where(), progress);
    t.effect = &effect;
    t.place = list[i].place;
    t.excitation = list[i].at;
    t.laws = {list[i].law};
    t.outputs = {output};
    t.contender = with_effect(shop, model, effect, list[i].law, list[i].place, list[i].at, Effort::full);
    t.admitted = t.contender.ok && why_implausible(effect, list[i].law, t.contender, list[i].at).empty();
    return false;
  });
  const int best = best_admitted(fitted);
  if (best < 0) return std::nullopt;
  Tried t = std::move(fitted[static_cast<std::size_t>(best)]);
  t.contender.error_of = books.evidence->error(t.contender.prediction);
  return t;
}

/// All of them, each on top of those before it; empty where one cannot be had.
std::vector<Tried> all_on(const Books& books, const std::vector<const Effect*>& effects, const std::string& output,
                          double progress) {
  std::vector<Tried> set;
  for (const Effect* e : effects) {
    if (books.stopped()) return {};
    auto t = with_effect_on(books, set.empty() ? books.current : set.back().contender, *e, output, progress);
    if (!t) return {};
    set.push_back(std::move(*t));
  }
  return set;
}

double excess_on(const ModelError& error, const std::string& output) {
  double excess = 0;
  for (const auto& r : error.recordings)
    if (r.role == Role::validate && r.output == output) excess += r.excess();
  return excess;
}

/// On recordings not used for the fit it is no chance, and it is worth its numbers.
bool speaks_for(const Contender& before, const Contender& after) {
  return before.error_of.evidence_validate - after.error_of.evidence_validate > rules::claim_fall &&
         after.score() < before.score();
}

/// As a first effect has to, the set takes most of what stands above the noise there, and none of it is needless.
bool belongs_there(const Books& books, const std::vector<Tried>& set, const std::string& output, double progress) {
  const Contender& all = set.back().contender;
  const double excess = excess_on(books.current.error_of, output);
  if (!speaks_for(books.current, all) || excess - excess_on(all.error_of, output) < rules::share_of_first * excess)
    return false;
  for (std::size_t i = 0; i + 1 < set.size(); ++i) {  // what the last one brings is known
    std::vector<const Effect*> others;
    for (std::size_t k = 0; k < set.size(); ++k)
      if (k != i) others.push_back(set[k].effect);
    const auto rest = all_on(books, others, output, progress);
    if (!rest.empty() && !speaks_for(rest.back().contender, all)) return false;
  }
  return speaks_for(set[set.size() - 2].contender, all);
}

}  // namespace

bool as_a_set_on_another_output(Books& books, double progress) {
  const auto outputs = books.base_model->outputs();
  if (outputs.size() < 2) return false;
  books.current.error_of = books.evidence->error(books.current.prediction);
  for (const auto& output : outputs) {
    const auto effects = missing_on(books, output);
    // One alone was asked for when it was found.
    if (effects.size() < 2 || !(excess_on(books.current.error_of, output) > 0)) continue;
    auto set = all_on(books, effects, output, progress);
    if (set.empty() || !belongs_there(books, set, output, progress)) continue;
    sharpen(books, set.back());
    for (auto& t : set) {
      const int step = static_cast<int>(books.d.steps.size()) + 1;
      take(books, step, t, {});
      std::vector<Tried> told{t};
      told.front().reason += "; with the others that stand on another axis";
      keep_candidates(books, told, step, 0, {});
    }
    return true;
  }
  return false;
}

}  // namespace hysteron
