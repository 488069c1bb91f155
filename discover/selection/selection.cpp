#include "discover/selection/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "discover/models/fit_cost.h"
#include "discover/selection/joint_step.h"
#include "discover/selection/slowness.h"
#include "engine/diagram/stop.h"

namespace hysteron {
namespace {

constexpr std::size_t at_once = 8;  // rivals that are fitted with all numbers before anybody looks at what is left
constexpr double half = 0.5;        // of the time that is left, where it is limited: what comes next has the other
constexpr int few_renewals = 3;     // of weights, for rivals that may not win
constexpr std::size_t enriched_names = 4;  // whose richer laws are fitted
constexpr std::size_t finalists = 3;       // that are fitted until their weights are those of what they leave

/// What a score needs.
TableModel without_prediction(const TableModel& f) {
  TableModel one;
  one.model.ok = f.model.ok;
  one.numbers = f.numbers;
  one.left = f.left;
  one.rounded = f.rounded;
  one.levels = f.levels;
  one.parameters = f.parameters;
  one.tried = f.tried;
  one.moved = f.moved;
  return one;
}

}  // namespace

std::vector<std::vector<std::size_t>> terms_of(const CandidateModel& model) {
  std::vector<std::vector<std::size_t>> terms;
  for (std::size_t i = 0; i < model.placed.size(); ++i) {
    const auto same = std::find_if(terms.begin(), terms.end(), [&](const auto& term) {
      return model.placed[term.front()].effect == model.placed[i].effect;
    });
    if (same == terms.end())
      terms.push_back({i});
    else
      same->push_back(i);
  }
  return terms;
}

Selection::Selection(SearchState& state, std::map<std::string, double> numbers)
    : state_(state), setting_(state, std::move(numbers)) {
  const auto before =
      std::exchange(state_.context.derivatives, std::make_shared<DerivativeStore>());  // of other recordings
  state_.context.derivatives->count(before->runs());
}

void Selection::remember(const TableModel& fitted) {
  if (fitted.ok() && !fitted.rounded) left_.push_back(fitted.left);  // within half a level no noise shows
}

void Selection::count_in(const LeftSums& left) {
  left_.push_back(left);
  measure();
}

/// What makes a law better that is then not the effect (a second mode that only shifts the phase) is not its gain.
bool Selection::is_better(const Addition& rival, const FitOfRival& other) const {
  if (!rival.fitted.ok()) return true;
  const bool before = why_not_itself(rival.fitted).empty();
  const bool now = why_not_itself(other.fitted).empty();
  return before == now ? score_of(rival.fitted) < score_of(other.fitted) : now;
}

/// The better of the fits of each rival, and its law. The table of all models grows first: by that they are compared.
void Selection::take_up(std::vector<Addition>& rivals, std::vector<FitsOfRival> answers) {
  for (const auto& list : answers)
    for (const auto& a : list) remember(a.fitted);
  measure();
  for (auto& list : answers)
    for (auto& a : list) {
      Addition& rival = rivals[a.rival];
      if (const auto known = rival.by_law.find(a.law); known == rival.by_law.end() || !known->second.ok() ||
                                                       (a.fitted.ok() && score_of(known->second) < score_of(a.fitted)))
        rival.by_law[a.law] = without_prediction(a.fitted);
      if (!a.fitted.ok()) {
        if (!rival.fitted.ok()) rival.fitted.model.error = a.fitted.model.error;
      } else if (is_better(rival, a)) {
        rival.fitted = std::move(a.fitted);
        rival.tried.law = a.law;
      }
    }
}

void Selection::measure() { setting_.score = std::make_shared<const BlockScore>(*state_.evidence, left_); }

void Selection::sort(std::vector<Addition>& rivals) const {
  std::stable_sort(rivals.begin(), rivals.end(), [&](const Addition& a, const Addition& b) {
    if (a.fitted.ok() != b.fitted.ok()) return a.fitted.ok();
    return a.fitted.ok() && score_of(a.fitted) > score_of(b.fitted);
  });
}

/// Every effect at every place, and at all like ones, of the present model.
std::vector<Addition> Selection::everywhere(int step) {
  std::vector<Addition> rivals;
  for (auto& t : list_candidates(state_, step)) {
    Addition rival;
    rival.tried = std::move(t);
    rivals.push_back(std::move(rival));
  }
  for (auto& a : at_like_places(state_, rivals)) rivals.push_back(std::move(a));
  return rivals;
}

std::vector<Addition> Selection::list(int step) {
  state_.current = best_.model;
  auto rivals = everywhere(step);
  // Names are counted: one that stands may act on a further axis too.
  const auto names = names_of(best_.model);
  if (static_cast<int>(names.size()) >= state_.options.max_steps)
    std::erase_if(rivals, [&](const Addition& r) { return !names.contains(r.tried.effect); });
  for (auto& r : rivals) r.slowness = slowness(state_, r.tried);
  return rivals;
}

/// Where time is short, who finds nothing in its part of it is asked again behind the others, with less effort.
void Selection::fit_first_laws(std::vector<Addition>& rivals, int step) {
  std::vector<std::pair<std::size_t, std::size_t>> jobs;  // rival, law
  for (std::size_t i = 0; i < rivals.size(); ++i)
    for (std::size_t l = 0; l < rivals[i].tried.laws.size(); ++l)
      if (l == 0 || rivals[i].tried.laws[l].apart) jobs.emplace_back(i, l);
  // Each answer of its own: the score that orders them is that of all.
  std::vector<FitsOfRival> answers(jobs.size());
  const double until = state_.after(half);
  const auto fit_one = [&](std::size_t j, const FitContext& context, bool quickly) {
    const auto [i, law] = jobs[j];
    const TriedEffect& t = rivals[i].tried;
    state_.progress(
        fmt::format("step {}: {} at {}", step, t.effect->id, t.place.where()),
        (step - 1 + 0.6 * static_cast<double>(j) / static_cast<double>(jobs.size())) / state_.options.max_steps);
    const double tried = ln_tried(rivals, *t.effect);
    const auto choice = term_of(rivals[i], law);
    const auto add = [&](const TableModel& from, Effort effort) {
      answers[j].push_back({i, law, with_term(setting_, context, from, choice, tried, effort)});
    };
    if (step == 1 && (quickly || rivals[i].slowness > 0)) {
      add(nulls_.let_go.ok() ? nulls_.let_go : nulls_.written, Effort::screen);
    } else if (step > 1) {
      add(best_, Effort::screen);
    } else {
      add(nulls_.written, Effort::full);
      if (nulls_.let_go.ok()) add(nulls_.let_go, Effort::full);
    }
    return false;
  };
  state_.side_by_side(
      jobs.size(), [&](std::size_t j, const FitContext& context) { return fit_one(j, context, false); }, until);
  std::vector<std::size_t> again;
  for (std::size_t j = 0; j < jobs.size(); ++j)
    if (std::none_of(answers[j].begin(), answers[j].end(), [](const FitOfRival& a) { return a.fitted.ok(); }) &&
        (answers[j].empty() || answers[j].front().fitted.model.stopped))
      again.push_back(j);
  state_.side_by_side(
      again.size(), [&](std::size_t k, const FitContext& context) { return fit_one(again[k], context, true); }, until);
  left_some_out_ = left_some_out_ || std::any_of(again.begin(), again.end(), [&](std::size_t j) {
                     return answers[j].empty() || !answers[j].back().fitted.ok();
                   });
  take_up(rivals, std::move(answers));
}

/// May the model, all of it fitted together, be claimed, and come within a tie of what is ahead (tie_score_of())?
bool Selection::may_win(const TableModel& f, const FitContext& context, Numbers numbers, double ahead) const {
  return may_reach(setting_, context, f, numbers, score_of(best_) + rules::by_score, ahead);
}

/// Together with all that stands and with the user's numbers, the likeliest first, until only noise is left.
void Selection::fit_with_numbers(std::vector<Addition>& rivals, const WhoIsAsked& who) {
  sort(rivals);
  const Numbers numbers = setting_.numbers.empty() ? Numbers::written : Numbers::let_go;
  double least = score().over_noise(best_.left_at_last());
  double ahead = who.ahead;
  for (const auto& r : rivals)
    if (r.fitted.ok()) {
      least = std::min(least, score().over_noise(r.fitted.left_at_last()));
      ahead = std::max(ahead, tie_score_of(score(), r.fitted));
    }
  const bool only_noise = least < rules::near_noise;
  const auto is_hopeless = [&](std::size_t i, const FitContext& context) {
    if (!only_noise && i < who.at_least) return false;  // to first order holds near what is right
    return !may_win(rivals[i].fitted, context, numbers, ahead);
  };
  const auto is_asked = [&](std::size_t i) {
    return rivals[i].fitted.ok() && (i < who.first || score_of(rivals[i].fitted) > who.more_than);
  };
  const std::size_t all = std::min(who.most, rivals.size());
  for (std::size_t first = 0; first < all && !state_.stopped(); first += at_once) {
    const std::size_t n = std::min(at_once, all - first);
    std::vector<FitsOfRival> answers(n);
    const auto fit_one = [&](std::size_t i, const FitContext& context) {
      const Addition& rival = rivals[first + i];
      if (is_asked(first + i) && !is_hopeless(first + i, context))
        answers[i] = {{first + i, rival.tried.law, refitted(setting_, context, rival.fitted, numbers, few_renewals)}};
      return false;
    };
    state_.side_by_side(n, fit_one, state_.after(half));
    take_up(rivals, std::move(answers));
    for (std::size_t i = 0; i < n; ++i)
      if (const TableModel& f = rivals[first + i].fitted; f.ok()) {
        ahead = std::max(ahead, tie_score_of(score(), f));
        least = std::min(least, score().over_noise(f.left_at_last()));
      }
    if (least < rules::near_noise) break;
  }
  sort(rivals);
}

/// Who may win is fitted until its weights are those of what it leaves.
void Selection::settle_best(std::vector<Addition>& rivals) {
  const std::size_t n = std::min(finalists, rivals.size());
  std::vector<FitsOfRival> answers(n);
  const double ahead = n > 0 && rivals.front().fitted.ok() ? tie_score_of(score(), rivals.front().fitted) : 0;
  state_.side_by_side(n, [&](std::size_t i, const FitContext& context) {
    const TableModel& f = rivals[i].fitted;
    if (f.ok() && f.numbers == Numbers::let_go && (i == 0 || may_win(f, context, f.numbers, ahead)))
      answers[i] = {{i, rivals[i].tried.law, refitted(setting_, context, f, f.numbers)}};
    return false;
  });
  take_up(rivals, std::move(answers));
  sort(rivals);
}

namespace {

/// Where another effect leaves noise only, each further number takes about one of chi2 away and costs two in what ties
/// are counted by, sqrt(2n) up or down: n more of them come within a tie where they take one and a half times that.
bool has_too_many_numbers(const Addition& best, const Addition& rival, std::size_t law) {
  constexpr std::size_t too_many = 15;
  return best.tried.effect != rival.tried.effect &&
         rival.tried.laws[law].free.size() > best.tried.laws[best.tried.law].free.size() + too_many;
}

}  // namespace

/// Of the best names the other laws, from where the first one's model stands. Of each name those that are quick,
/// and those of the block that explains most from there, are fitted with the user's numbers, which make up for what the
/// first law lacks until then.
void Selection::fit_richer_laws(std::vector<Addition>& rivals) {
  std::set<std::string> names;
  std::vector<std::pair<std::size_t, std::size_t>> jobs;  // rival, law
  const bool only_noise = !rivals.empty() && rivals.front().fitted.ok() &&
                          score().over_noise(rivals.front().fitted.left_at_last()) < rules::near_noise;
  for (std::size_t i = 0; i < rivals.size(); ++i) {
    if (!rivals[i].fitted.ok()) continue;
    if (names.size() >= enriched_names && !names.contains(rivals[i].tried.effect->id)) break;
    if (!names.insert(rivals[i].tried.effect->id).second) continue;  // at its best place
    for (std::size_t l = 1; l < rivals[i].tried.laws.size(); ++l)
      if (!rivals[i].tried.laws[l].apart &&  // those stood among the first
          !(only_noise && has_too_many_numbers(rivals.front(), rivals[i], l)))
        jobs.emplace_back(i, l);
  }
  std::vector<FitsOfRival> answers(jobs.size());
  state_.side_by_side(jobs.size(), [&](std::size_t j, const FitContext& context) {
    const auto [i, law] = jobs[j];
    // With the numbers of the simple law's model: those of the null bear what the effect does.
    std::vector<std::size_t> last(rivals[i].also.size() + 1);  // it came last
    std::iota(last.begin(), last.end(), rivals[i].fitted.model.placed.size() - last.size());
    const TableModel bare = without_term(setting_, context, rivals[i].fitted, last);
    if (!bare.ok()) return false;
    const double tried = ln_tried(rivals, *rivals[i].tried.effect);
    answers[j] = {{i, law, with_term(setting_, context, bare, richer_term_of(rivals[i], law), tried, Effort::full)}};
    return false;
  });
  for (const auto& list : answers)
    for (const auto& a : list) remember(a.fitted);
  measure();
  const auto type_of = [&](const FitOfRival& a) { return rivals[a.rival].tried.laws[a.law].block.type; };
  const auto is_quick = [](const FitOfRival& a) { return work_of_a_step(*a.fitted.model.program) <= 1; };
  std::vector<const FitOfRival*> best(rivals.size(), nullptr);
  for (const auto& list : answers)
    for (const auto& a : list) {
      const FitOfRival*& ahead = best[a.rival];
      if (a.fitted.ok() && (ahead == nullptr || score_of(a.fitted) > score_of(ahead->fitted))) ahead = &a;
    }
  std::vector<const FitOfRival*> asked;
  for (const auto& list : answers)
    for (const auto& a : list)
      if (a.fitted.ok() && (is_quick(a) || type_of(a) == type_of(*best[a.rival]))) asked.push_back(&a);
  const Numbers numbers = setting_.numbers.empty() ? Numbers::written : Numbers::let_go;
  std::vector<FitsOfRival> settled(asked.size());
  double ahead = asked.empty() ? 0 : tie_score_of(score(), rivals.front().fitted);
  for (const auto* a : asked) ahead = std::max(ahead, tie_score_of(score(), a->fitted));
  state_.side_by_side(asked.size(), [&](std::size_t k, const FitContext& context) {
    const FitOfRival& a = *asked[k];
    const bool may = may_win(a.fitted, context, numbers, ahead);
    settled[k] = {{a.rival, a.law, may ? refitted(setting_, context, a.fitted, numbers, few_renewals) : a.fitted}};
    return false;
  });
  take_up(rivals, std::move(settled));
  sort(rivals);
}

bool Selection::is_itself(const Addition& rival) const { return why_not_itself(rival.fitted).empty(); }

/// Those that are quick first, the likeliest of them with the user's numbers; the slow ones where these leave more than
/// noise; and what is left of the quick ones where that is more than noise still. Of the slow ones the first are fitted
/// with the numbers and those that explain more than the best of the quick; of the slowest those that explain more than
/// the others did before their numbers were let go.
void Selection::fit(std::vector<Addition>& rivals, int step) {
  std::vector<Addition> all, others;  // of the quick those that have been asked, and those that have not
  double at_first = -std::numeric_limits<double>::infinity();
  const auto is_over = [&] {
    return state_.stopped() || (!all.empty() && all.front().fitted.ok() &&
                                score().over_noise(all.front().fitted.left_at_last()) < rules::near_noise);
  };
  for (int slow = 0; slow <= slowest; ++slow) {
    std::vector<Addition> some;
    for (auto& r : rivals)
      if (r.slowness == slow) some.push_back(std::move(r));
    if (!some.empty() && !is_over()) {
      fit_first_laws(some, step);
      std::vector<TableModel> begun;  // what they left, before the user's numbers were let go beside them
      for (const auto& r : some)
        if (r.fitted.ok()) begun.push_back(without_prediction(r.fitted));
      const bool race = !all.empty() && all.front().fitted.ok();
      WhoIsAsked who{.at_least = at_once};
      if (slow == 0) who.most = at_once;
      if (race) {
        who.first = slow < slowest ? finalists : 0;
        who.more_than = slow < slowest ? score_of(all.front().fitted) : at_first;
        who.ahead = tie_score_of(score(), all.front().fitted);
      }
      fit_with_numbers(some, who);
      for (const auto& f : begun) at_first = std::max(at_first, score_of(f));
    }
    if (slow == 0 && some.size() > at_once) {
      others.assign(std::make_move_iterator(some.begin() + at_once), std::make_move_iterator(some.end()));
      some.resize(at_once);
    }
    all.insert(all.end(), std::make_move_iterator(some.begin()), std::make_move_iterator(some.end()));
    sort(all);
  }
  if (!others.empty() && !is_over())
    fit_with_numbers(others, {.ahead = all.front().fitted.ok() ? tie_score_of(score(), all.front().fitted)
                                                               : -std::numeric_limits<double>::infinity()});
  all.insert(all.end(), std::make_move_iterator(others.begin()), std::make_move_iterator(others.end()));
  sort(all);
  rivals = std::move(all);
  fit_richer_laws(rivals);
  settle_best(rivals);
}

/// What asks for less to be believed and explains as much (Effect::plainer), or the rival itself: a gain that is wrong
/// needs no story, one that changes with use does.
const Addition& Selection::plainest_like(const Addition& rival, const std::vector<Addition>& rivals) const {
  for (const auto& r : rivals)
    if (r.fitted.ok() && is_plainer(*r.tried.effect, *rival.tried.effect) && r.tried.outputs == rival.tried.outputs &&
        tie_score_of(score(), r.fitted) > tie_score_of(score(), rival.fitted) - rules::tie && is_itself(r))
      return r;
  return rival;
}

bool Selection::add_one(int step) {
  unclaimed_ = false;
  auto rivals = list(step);
  if (rivals.empty()) return false;
  const bool was_left_out = std::exchange(left_some_out_, false);
  fit(rivals, step);
  const bool broken_off = state_.stopped() || left_some_out_;
  left_some_out_ = left_some_out_ || was_left_out;
  const StopScope to_its_end(nullptr);  // what was fitted until then is compared
  for (auto& r : rivals) r.tried.candidate = r.fitted.model;
  rounds_.push_back({best_, std::move(rivals), broken_off});
  unclaimed_ = true;
  return claim_of_last_round();
}

/// Who was not asked might have been the one, but where hardly anything is left to explain.
bool Selection::may_be_claimed(const TableModel& f, const TableModel& before, bool broken_off) const {
  if (score_of(f) <= score_of(before) + rules::by_score) return false;
  return !broken_off || score().over_noise(f.left_at_last()) <= rules::near_noise ||
         score().leaves_little(f.left_at_last(), before.left_at_last());
}

/// Asked once more when others have been fitted: what noise is taken for is read off all of them.
bool Selection::claim_of_last_round() {
  if (!unclaimed_) return false;
  Round& round = rounds_.back();
  sort(round.rivals);
  const TableModel& before = round.on.model.placed.empty() ? nulls_.better(score()) : round.on;
  for (const auto& r : round.rivals) {
    if (r.fitted.ok() && !is_itself(r)) continue;
    if (!r.fitted.ok() || !may_be_claimed(r.fitted, before, round.broken_off)) break;
    best_ = plainest_like(r, round.rivals).fitted;
    unclaimed_ = false;
    return true;
  }
  best_ = before;
  return false;
}

namespace {

/// The best model steps back for others to be searched beside; it stands again where that search is broken off.
struct StandsAgain {
  explicit StandsAgain(TableModel& best) : model(best), best_(best) {}
  ~StandsAgain() {
    if (!found) best_ = std::move(model);
  }
  StandsAgain(const StandsAgain&) = delete;
  StandsAgain& operator=(const StandsAgain&) = delete;
  TableModel model;
  bool found = false;  ///< another one took its place

 private:
  TableModel& best_;
};

}  // namespace

/// Where more than noise is left and nothing is claimed alone: one of the best of the last round and one more effect on
/// it. Each shows its worth only beside the other; who does not, leaves again (leave_out).
bool Selection::add_two(int step) {
  constexpr std::size_t beginnings = 3;
  const bool room = static_cast<int>(names_of(best_.model).size()) + 2 <= state_.options.max_steps;
  if (!room || state_.stopped() || rounds_.empty() || score().over_noise(best_.left_at_last()) <= rules::near_noise)
    return false;
  StandsAgain before(best_);
  std::vector<TableModel> first;
  std::set<const Effect*> names;
  for (const auto& r : rounds_.back().rivals)
    if (first.size() < beginnings && r.fitted.ok() && is_itself(r) && names.insert(r.tried.effect).second)
      first.push_back(r.fitted);
  std::optional<Round> best;
  for (const auto& one : first) {
    best_ = one;
    auto rivals = list(step);
    std::erase_if(rivals, [](const Addition& r) { return r.slowness > 0; });  // there are three times as many
    if (rivals.empty() || state_.stopped()) break;
    fit_first_laws(rivals, step);
    sort(rivals);
    rivals.resize(std::min(rivals.size(), at_once));
    fit_with_numbers(rivals, {.at_least = at_once});
    std::erase_if(rivals, [&](const Addition& r) { return r.fitted.ok() && !is_itself(r); });
    if (rivals.empty() || !rivals.front().fitted.ok()) continue;
    if (best && score_of(best->rivals.front().fitted) >= score_of(rivals.front().fitted)) continue;
    best = Round{one, std::move(rivals)};
  }
  best_ = before.model;
  if (!best || state_.stopped() || !may_be_claimed(best->rivals.front().fitted, best_, left_some_out_)) return false;
  before.found = true;
  best_ = best->rivals.front().fitted;
  for (auto& r : best->rivals) r.tried.candidate = r.fitted.model;
  rounds_.push_back(std::move(*best));
  return true;
}

void Selection::run(const std::function<bool(const TableModel&)>& is_over) {
  nulls_ = fit_nulls(setting_);
  remember(nulls_.written);
  remember(nulls_.let_go);
  measure();
  best_ = nulls_.better(score());
  const int axes = static_cast<int>(state_.base_model->outputs().size());
  const int most = 3 * state_.options.max_steps + axes;  // a name or two may leave for each that stays
  for (int step = 1; step <= most && !state_.stopped(); ++step) {
    if (!add_one(step) && !add_two(step + 1) && !in_two() && !claim_of_last_round()) break;
    {
      const StopScope to_its_end(nullptr);  // what is not needed is not claimed, however little time there was
      while (leave_out()) continue;
    }
    if (best_.model.placed.empty()) break;
    for (int turn = 0; turn < state_.options.max_steps && !state_.stopped() && exchange();) ++turn;
    if (!state_.stopped() && is_over(best_)) break;
  }
}

}  // namespace hysteron
