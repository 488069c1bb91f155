// Decides the order of a discovery: base fit, every admissible candidate alone, richer laws, claim, further effects
// with guards, exchange of look-alikes, ties and the experiment that would break them, generic structures as
// competitors, verdict. Does not decide what counts as chance (judge_step.cpp) nor how anything is told (words.cpp).
#include "discover/search/discover.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <utility>

#include "discover/models/parts.h"
#include "discover/search/between_samples.h"
#include "discover/search/nominal_parameters.h"
#include "discover/search/room.h"
#include "discover/search/search_state.h"
#include "engine/diagram/error.h"
#include "engine/diagram/stop.h"

namespace hysteron {
namespace {

/// Lines of the mains in the user's own model, by the output that they are on. Nobody knows their phase in a recording
/// that was not there yet.
void lines_of_user(const SearchState& state, std::vector<std::optional<WanderingLine>>& lines) {
  const Effect* mains = state.effects.find("mains_interference");
  if (mains == nullptr) return;
  const Program& program = state.base_model->program();
  for (const auto& block : program.blocks) {
    if (block.kernel->declaration.type != mains->block_type) continue;
    const auto* frequency = program.find_parameter(block.path + ".frequency");
    int harmonics = 0;
    while (program.find_parameter(fmt::format("{}.cosine[{}]", block.path, harmonics)) != nullptr) ++harmonics;
    if (frequency == nullptr || harmonics == 0) continue;
    for (const int o : outputs_behind(program, program.block_index(block.path)))
      for (std::size_t k = 0; k < lines.size(); ++k)
        if (state.base_model->outputs()[k] == program.output_names[static_cast<std::size_t>(o)])
          lines[k] = WanderingLine{frequency->value, harmonics, true};
  }
}

/// Lines of the mains that stand, by the output that they are on.
std::vector<std::optional<WanderingLine>> lines_of(const SearchState& state, const CandidateModel& model) {
  std::vector<std::optional<WanderingLine>> lines(state.base_model->outputs().size());
  lines_of_user(state, lines);
  for (std::size_t i = 0; i < model.placed.size(); ++i)
    for (const auto& p : parameters_of(model, static_cast<int>(i))) {
      if (p.law->line_bands.empty() || p.estimate == nullptr) continue;
      // A cosine and a sine of each harmonic are found anew in each recording.
      const auto& free = model.placed[i].law.free;
      const auto amplitudes = std::count_if(free.begin(), free.end(), [](const auto& f) { return f.per_recording; });
      for (const int o : measured_moved(state, model, model.placed[i].place.moves_from()))
        lines[static_cast<std::size_t>(o)] = WanderingLine{p.estimate->used, static_cast<int>(amplitudes / 2), false};
    }
  return lines;
}

}  // namespace

SearchState::SearchState(const Diagram& diagram, const DataSet& given, const Registry& all_blocks,
                         const Effects& all_effects, const DiscoverOptions& wishes)
    : registry(all_blocks),
      effects(all_effects),
      options(wishes),
      data(std::make_shared<const DataSet>(given)),
      user(diagram) {
  context.registry = &registry;
  context.data = data;
  context.free_paths = options.free_paths;
  context.looser = options.looser;
  context.threads = options.threads;
}

void SearchState::progress(const std::string& what, double done) const {
  if (!options.progress) return;
  const std::lock_guard one_at_a_time(telling_);
  options.progress(what, std::min(done, 1.0));
}

bool SearchState::unless_stopped(const std::function<void()>& work) const {
  const StopScope scope([this] { return stopped(); });
  try {
    work();
    return true;
  } catch (const Stopped&) {
    return false;
  }
}

std::size_t SearchState::side_by_side(std::size_t n,
                                      const std::function<bool(std::size_t, const FitContext&)>& job) const {
  std::vector<std::shared_ptr<DerivativeStore>> derivatives(n);
  std::atomic<std::size_t> first{n};
  context.threads.each(n, [&](std::size_t i) {
    if (i > first || stopped()) return;
    FitContext own = context;
    own.derivatives = derivatives[i] = std::make_shared<DerivativeStore>(context.derivatives);
    bool answer = false;
    unless_stopped([&] { answer = job(i, own); });
    if (!answer) return;
    for (std::size_t was = first; i < was && !first.compare_exchange_weak(was, i);) continue;
  });
  for (std::size_t i = 0; i < n && i <= first; ++i)
    if (derivatives[i]) context.derivatives->add(*derivatives[i]);
  return first;
}

bool SearchState::wanted(const Effect& effect) const {
  if (options.only.empty()) return effect.law_of.empty();
  return std::find(options.only.begin(), options.only.end(), effect.id) != options.only.end();
}

void SearchState::settle(CandidateModel& best) {
  evidence->known_lines(lines_of(*this, best), [&] { return without_lines(context, best); });
  evidence->settle(best.prediction);
  best.error_of = evidence->error(best.prediction);
}

Found::Found(const SearchState& state)
    : current_(state.current),
      before_prediction_(state.before_prediction),
      steps_(state.d.steps),
      candidates_(state.d.candidates) {}

void Found::restore(SearchState& state) const {
  state.current = current_;
  state.before_prediction = before_prediction_;
  state.d.steps = steps_;
  state.d.candidates = candidates_;
  state.settle(state.current);
}

void fit_candidates(SearchState& state, std::vector<TriedEffect>& tried, int step) {
  state.side_by_side(tried.size(), [&](std::size_t i, const FitContext& context) {
    TriedEffect& t = tried[i];
    const double part = 0.6 * static_cast<double>(i) / static_cast<double>(tried.size());
    state.progress(fmt::format("step {}: {} at {}", step, t.effect->id, t.place.where()),
                   (step - 1 + part) / state.options.max_steps);
    t.candidate = with_effect(context, state.current, *t.effect, t.laws.front(), t.place, t.excitation,
                              step == 1 || taken_up(state, *t.effect) ? Effort::full : Effort::screen);
    return false;
  });
}

void keep_candidates(SearchState& state, const std::vector<TriedEffect>& tried, int step, int winner,
                     const std::vector<int>& ties) {
  for (std::size_t i = 0; i < tried.size(); ++i) {
    Candidate c = candidate_of(tried[i], step);
    c.claimed = static_cast<int>(i) == winner;
    if (std::find(ties.begin(), ties.end(), static_cast<int>(i)) != ties.end())
      c.reason = "explains the recordings as well as the one that was taken: " + c.reason;
    else if (tried[i].admitted && !c.claimed)
      c.reason = "less than the one that was taken: " + c.reason;
    state.d.candidates.push_back(std::move(c));
  }
}

bool unless_it_fails(SearchState& state, const std::function<bool()>& search) {
  const Found found(state);
  const auto go_back = [&] {
    const StopScope to_its_end(nullptr);
    found.restore(state);
  };
  try {
    bool answer = false;
    if (!state.unless_stopped([&] { answer = search(); })) go_back();
    return answer;
  } catch (const Error& e) {
    go_back();
    auto& told = state.d.warnings;
    const std::string early = fmt::format("the search for further effects ended early: {}", e.what());
    if (std::find(told.begin(), told.end(), early) == told.end()) told.push_back(early);
    return false;
  }
}

namespace {

/// Index of the candidate that a step claims, -1 = none.
int who_wins(SearchState& state, std::vector<TriedEffect>& tried) {
  for (int winner = best_admitted(tried); winner >= 0; winner = best_admitted(tried)) {
    sharpen_rivals(state, tried, static_cast<std::size_t>(winner));
    winner = best_admitted(tried);
    if (winner < 0) break;
    winner = plainer_first(tried, held_one_first(state, tried, calibration_first(tried, winner)));
    if (stays_itself(state, tried[static_cast<std::size_t>(winner)])) return winner;
  }
  return -1;
}

/// What is left to do of a step once its candidates are fitted. Where it is stopped meanwhile it is done again with
/// what there is by then: all that takes time is left out.
void decide(const SearchState& state, const std::function<void()>& work) {
  if (!state.stopped() && state.unless_stopped(work)) return;
  const StopScope to_its_end(nullptr);
  work();
}

/// False if nothing was claimed. `kept`: what was tried; `outputs`: only what moves none but these, all if empty.
bool one_step(SearchState& state, int step, As as, std::vector<TriedEffect>* kept,
              const std::vector<std::string>& outputs = {}, const std::vector<const Effect*>& only = {}) {
  const auto progress = [&](double part) { return (step - 1 + part) / state.options.max_steps; };
  auto tried = list_candidates(state, step, outputs, only);
  fit_candidates(state, tried, step);
  if (step > 1 && state.stopped()) {  // who was not asked might have been the one
    keep_candidates(state, tried, step, -1, {});
    return false;
  }
  join_twins(tried);
  int winner = -1;
  std::vector<int> ties;
  bool numbers = false;
  const CandidateModel before = state.current;
  decide(state, [&] {
    compare_all(state, tried, as);
    if (step > 1) refit_best(state, tried, as, progress(0.7));
    enrich(state, tried, step, as, progress(0.8));
    winner = who_wins(state, tried);
    numbers = are_the_numbers(state, winner >= 0 ? &tried[static_cast<std::size_t>(winner)] : nullptr);
    if (winner < 0 || numbers) return;
    try_hidden(state, tried, *tried[static_cast<std::size_t>(winner)].effect, as);
    ties = ties_of(state, tried, static_cast<std::size_t>(winner));
    as_on_another_axis(state, tried, winner, ties);
    claim(state, step, tried, static_cast<std::size_t>(winner), ties, progress(0.9));
  });
  if (numbers) {
    keep_candidates(state, tried, step, -1, {});
    return false;
  }
  if (winner >= 0) {
    const std::string id = tried[static_cast<std::size_t>(winner)].effect->id;
    unless_it_fails(state, [&] {
      in_two(state, before, progress(0.92));
      on_other_outputs(state, id, tried, progress(0.93));
      if (found_effects(state) > 1) reconsider(state, progress(0.95), Came::one_by_one, &before);
      return true;
    });
  }
  keep_candidates(state, tried, step, winner, ties);
  if (kept != nullptr) *kept = std::move(tried);
  return winner >= 0;
}

/// A calibration, and what looks like one; none where a calibration is not asked for.
std::vector<const Effect*> straight_effects(const SearchState& state) {
  const Effect* calibration = state.effects.find("calibration");
  if (calibration == nullptr) return {};
  std::vector<const Effect*> list{calibration};
  for (const auto& e : state.effects.list())
    if (look_alike(e, *calibration)) list.push_back(&e);
  return list;
}

/// Is more than the noise of sensors left in a recording or in all of them, or where an effect is a few coefficients
/// beside which all the others are noise: by plain squares, or in one octave.
bool more_than_noise(const SearchState& state) {
  const OverFloor over = state.evidence->over_usual_floor(state.current.prediction);
  const double plain = state.evidence->plain_over_floor(state.current.error_of);
  return std::max({over.all, over.one, plain}) > rules::floor_gate || over.octave > rules::octave_gate;
}

/// A wrong zero hides: a law that finds it anew swallows it, and without one it is a constant, a single coefficient in
/// each recording, beside which all the others are noise. Only a straight effect is asked for.
void a_wrong_zero(SearchState& state) {
  const auto straight = straight_effects(state);
  const bool room = found_effects(state) < state.options.max_steps && !state.stopped();
  if (!room || straight.empty() || state.d.steps.empty()) return;
  with_the_zero_held(state, [&] {
    const int step = static_cast<int>(state.d.steps.size()) + 1;
    return more_than_noise(state) && one_step(state, step, As::further, nullptr, {}, straight);
  });
}

/// Asked where something is left: what a calibration stands for beside a curve of the sensor is that curve's, too.
bool another_than_the_zero(SearchState& state) {
  if (!more_than_noise(state)) return false;
  return with_the_zero_of_a_curve(
      state, [&] { return one_step(state, static_cast<int>(state.d.steps.size()) + 1, As::further, nullptr); });
}

/// Steps on top of those that stand, until only noise is left or nothing helps. `first`: what the first one tried.
void one_by_one(SearchState& state, std::vector<TriedEffect>& first) {
  std::vector<TriedEffect> last;
  const int most = state.options.max_steps, axes = static_cast<int>(state.base_model->outputs().size());
  Room room(found_effects(state), most, 3 * most + axes);  // a name or two may leave for each that stays
  while (room.left(found_effects(state)) && !state.stopped()) {
    const int step = static_cast<int>(state.d.steps.size()) + 1;
    if (more_than_noise(state)) state.smooth = find_smooth_input(state);
    if (state.begins_anew()) return;
    if (step == 1) {
      if (!one_step(state, step, As::further, &first) && !state.begins_anew() && !on_axes_together(state, first)) break;
      room.took_a_name();
      continue;
    }
    const bool more =
        more_than_noise(state) && unless_it_fails(state, [&] {
          return one_step(state, step, As::further, &last) || (!state.begins_anew() && two_more(state, last));
        });
    if (state.begins_anew()) return;
    if (more) {
      room.took_a_name();
      continue;
    }
    // An output that nothing found so far moves is judged as if it were alone: nobody's imperfect law left anything
    // there.
    const auto alone = untouched_outputs(state);
    if (!alone.empty() && unless_it_fails(state, [&] { return one_step(state, step, As::first, nullptr, alone); })) {
      room.took_a_name();
      continue;
    }
    if (!unless_it_fails(state, [&] { return as_a_set_on_another_output(state, 0.9); })) break;
    room.took_no_name();
  }
  unless_it_fails(state, [&] { return a_wrong_zero(state), true; });
}

/// All steps, or as many as it takes to see that an input moves smoothly: then SearchState::smooth says so.
void steps_and_second_thoughts(SearchState& state) {
  std::vector<TriedEffect> first;
  one_by_one(state, first);
  const auto zero = [&] { return unless_it_fails(state, [&] { return another_than_the_zero(state); }); };
  if (!state.begins_anew() && zero()) one_by_one(state, first);
  // A look-alike that went first can bar the way to a pair that explains everything, and so can each of the pair.
  if (!state.begins_anew() && unless_it_fails(state, [&] { return another_beginning(state, first); }))
    one_by_one(state, first);
  if (!state.begins_anew() && unless_it_fails(state, [&] { return no_patch_of_anything(state, first); }))
    one_by_one(state, first);
  // Its law was chosen while others were missing: beside them a richer one may hold more, or a simpler one as much.
  const bool rest = !state.evidence->noise_known() || more_than_noise(state);
  if (!state.begins_anew() && rest && unless_it_fails(state, [&] { return refine_what_stands(state, 0.96); }))
    one_by_one(state, first);
  if (!state.begins_anew() && zero()) one_by_one(state, first);
  if (!state.begins_anew() && unless_it_fails(state, [&] { return are_numbers_in_place_of_an_effect(state); })) return;
  if (!state.begins_anew() && !state.stopped())
    unless_it_fails(state, [&] { return ties_beside_what_came_later(state, 0.96), true; });
}

void search(SearchState& state) {
  fit_base(state);
  const Found base(state);
  if (!state.unless_stopped([&] { steps_and_second_thoughts(state); }) && state.d.steps.empty()) base.restore(state);
}

/// Searches of one discovery: what one finds of the inputs or of the model's numbers the next begins with.
class Searches {
 public:
  /// A search by all that is known by now.
  std::unique_ptr<SearchState> next(const Diagram& diagram, const DataSet& data, const Registry& registry,
                                    const Effects& effects, const DiscoverOptions& options) {
    auto state = std::make_unique<SearchState>(diagram, as_found(data, with_), registry, effects, options);
    state->d.smooth_inputs = with_.smooth_inputs;
    state->d.asked_for = options.only;
    if (!numbers_.empty()) state->context.free_nominal_parameters(numbers_);
    search(*state);
    runs_ += state->context.derivatives->runs();
    return state;
  }

  /// Does all begin anew after this search? If not, it is the one to conclude, or gives way to an earlier one.
  bool begin_anew(std::unique_ptr<SearchState>& state) {
    const bool stopped = state->stopped();
    if (!stopped && !state->other_numbers.empty()) {
      numbers_ = state->other_numbers;
      return keep(state, before_, "with other numbers of the model");
    }
    if (!stopped && state->smooth) {
      with_.smooth_inputs.push_back(*state->smooth);
      return keep(state, before_, state->smooth->input + " moves smoothly between its samples");
    }
    if (held_) return after_numbers_were_let_go(state);
    if (numbers_.empty()) {
      state->unless_stopped([&] { numbers_ = numbers_to_try(*state); });
      if (!numbers_.empty()) return keep(state, held_, "with all numbers of the model let go");
    }
    // Broken off before it had found again what was found without: that is still true.
    if (before_ && stopped && found_effects(*state) < found_effects(*before_)) state = std::move(before_);
    return false;
  }
  /// What the last search but one has found, where the last one was broken off before it had begun; null if there was
  /// none.
  std::unique_ptr<SearchState> found_before() { return std::move(held_ ? held_ : before_); }
  long runs() const { return runs_; }

 private:
  static bool keep(std::unique_ptr<SearchState>& state, std::unique_ptr<SearchState>& as, const std::string& how) {
    state->progress("anew: " + how, 0);
    as = std::move(state);
    return true;
  }

  bool after_numbers_were_let_go(std::unique_ptr<SearchState>& state) {
    numbers_.clear();
    if (!state->stopped()) state->unless_stopped([&] { numbers_ = numbers_that_help(*state, *held_); });
    if (!numbers_.empty()) return keep(held_, before_, "with the fewest of these numbers");
    state = std::move(held_);
    return false;
  }

  Discovery with_;                         ///< how inputs move, as far as that is known by now
  std::map<std::string, double> numbers_;  ///< of the model, that are let go, as written [SI]
  std::unique_ptr<SearchState> before_;    ///< what was found without the last of these
  std::unique_ptr<SearchState> held_;      ///< what was found with the numbers as written, while all are let go
  long runs_ = 0;
};

}  // namespace

Discovery discover(const Diagram& diagram, const DataSet& data, const Registry& registry, const Effects& effects,
                   const DiscoverOptions& options) {
  Searches searches;
  auto state = searches.next(diagram, data, registry, effects, options);
  while (searches.begin_anew(state)) try {
      state = searches.next(diagram, data, registry, effects, options);
    } catch (const Stopped&) {
      state = searches.found_before();
      break;
    }
  if (state->smooth) tell_unused(*state);
  if (!state->other_numbers.empty()) tell_unused_numbers(*state);
  conclude(*state);
  state->d.model_runs = searches.runs();
  return std::move(state->d);
}

Discovery diagnose(const Diagram& diagram, const DataSet& data, const Registry& registry, const Effects& effects,
                   DiscoverOptions options) {
  options.max_steps = 1;
  return discover(diagram, data, registry, effects, options);
}

}  // namespace hysteron
