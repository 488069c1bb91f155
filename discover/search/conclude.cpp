// Decides the verdict of a discovery: effects, a generic structure that explains more, or nothing; and what is told of
// what is left.
#include <fmt/format.h>

#include <algorithm>

#include "discover/search/between_samples.h"
#include "discover/search/members.h"
#include "discover/search/nominal_parameters.h"
#include "discover/search/structures_tried.h"
#include "engine/diagram/stop.h"
#include "fit/signals/unit_words.h"

namespace hysteron {
namespace {

/// What the effects take away of what a gain and an offset leave: a structure is counted from there too.
ByRole removed_beyond_calibration(const SearchState& state, const Structure& s) {
  ByRole removed = s.beyond_calibration;
  for (const auto& r : state.current.error_of.recordings)
    if (r.role != Role::test && r.output == s.output) removed.of(r.role == Role::train) -= r.chi2;
  return removed;
}

/// What a structure has to take away beyond the effects. A clamp is a kink at a level, too: where effects leave only
/// noise a structure must be better by more than their laws may have left.
ByRole to_be_taken_beyond(const SearchState& state) {
  ByRole left;
  const auto by_laws = left_by_laws_of(state, state.current);
  for (std::size_t i = 0; i < by_laws.size(); ++i)
    left.of(state.current.error_of.recordings[i].role == Role::train) += by_laws[i];
  if (!state.d.steps.empty() && state.current.error_of.over_floor() <= rules::floor_gate)
    left.validate += rules::claim_fall;
  else
    left.validate = 0;
  return left;
}

/// A line where a standing law looks for lines is that law's: it wanders a little, and its law does not.
bool is_of_a_standing_law(const SearchState& state, const Structure& s) {
  if (s.kind != "line_in_time" || !(s.period > 0)) return false;
  for (const auto& standing : state.current.placed)
    for (const auto& p : standing.law.free)
      for (const auto& [low, high] : p.line_bands)
        if (low * s.period <= 1 && 1 <= high * s.period) return true;
  return false;
}

std::string holds_too_little(const Structure& s) {
  return fmt::format("holds {}, and not the {} of what stands above the noise that are asked",
                     percent(std::max(0.0, s.share_removed)), percent(rules::structure_share));
}

/// What stands on the way to another output says nothing about it, nor it about that.
bool has_a_rival(const SearchState& state, const Structure& s) {
  const auto& outputs = state.base_model->outputs();
  return std::any_of(state.current.placed.begin(), state.current.placed.end(), [&](const PlacedEffect& standing) {
    const auto moved = measured_moved(state, state.current, standing.place.moves_from());
    return std::any_of(moved.begin(), moved.end(),
                       [&](int o) { return outputs[static_cast<std::size_t>(o)] == s.output; });
  });
}

/// What it has to take away to be told in place of the effects: of the recordings where it was looked for it has to
/// explain more than they do.
Requirement beside_effects(const SearchState& state, const Structure& s, Where where) {
  if (!s.explains()) return {{}, "bursts only say when, and explain nothing"};
  if (is_of_a_standing_law(state, s)) return {{}, "a law that stands looks for lines there: this one is its own"};
  if (!(s.share_removed > rules::structure_share)) return {{}, holds_too_little(s)};
  if (!state.current.placed.empty() && !has_a_rival(state, s)) return {{}, "the effects stand before other outputs"};
  const ByRole removed = removed_beyond_calibration(state, s), beyond = to_be_taken_beyond(state);
  const double by_effects =
      where == Where::validation ? removed.validate + beyond.validate : removed.all() + beyond.all();
  const double needed = std::max(by_effects, rules::claim_fall);
  if (over(s.fall, where) > needed) return {needed, ""};
  return {needed, needed > rules::claim_fall ? "the effects that were found take more away" : "no more than chance"};
}

/// In all recordings, where one is left unexplained: what rings as a pump hums explains one recording that it is fitted
/// to, and not the next; and those that judge may be too short to show the pump. Where these prove the effects, they
/// decide.
JudgedSearch in_all_recordings(const SearchState& state) {
  JudgedSearch judged{{}, Where::all_recordings, {}};
  if (state.evidence->over_usual_floor(state.current.prediction).one <= rules::floor_gate) return judged;
  state.unless_stopped([&] {
    judged.search =
        find_structures(*state.evidence, state.base.prediction, state.context.threads, Where::all_recordings);
  });
  const Structure* s = judged.search.winner();
  if (s == nullptr) return judged;
  if (removed_beyond_calibration(state, *s).validate > rules::hardly_shown * s->fall.all())
    judged.requirement.why_not = "the recordings that judge prove the effects, and decide";
  else
    judged.requirement = beside_effects(state, *s, Where::all_recordings);
  return judged;
}

bool wins(const JudgedSearch& judged) { return judged.search.best >= 0 && judged.requirement.passed(); }

/// Other recordings show more of it than chance, and it holds a good part of what is left.
Requirement to_stand_out(const Structure& s) {
  if (!(s.fall.validate > rules::claim_fall)) return {rules::claim_fall, "no more than chance"};
  return {rules::claim_fall, s.share_removed > rules::structure_share ? "" : holds_too_little(s)};
}

/// What the user's model leaves on recordings that judge.
struct Left {
  bool more_than_noise = false;
  double most = 0;         ///< chi2/N, or that over what the usual noise makes, whichever is more
  StructureSearch search;  ///< made where more than noise is left
  bool looked_at = true;   ///< false: broken off before that
  const Structure* structure() const { return search.winner(); }
  bool told() const { return structure() != nullptr && structure()->fall.validate > rules::claim_fall; }
  /// Where no effect stands. chi2/N alone speaks of the noise model as much as of the plant: slow noise of unknown size
  /// lifts it too, and where all that is left is slow, as much 1/f noise as would explain it is read off it: more than
  /// sensors have is none.
  bool is_unexplained() const {
    return more_than_noise &&
           (!looked_at || (structure() != nullptr && to_stand_out(*structure()).passed()) || most > rules::slow_noise);
  }
};

Left left_by_base(const SearchState& state) {
  const double over = state.evidence->error(state.base.prediction).over_floor();
  const double over_usual = state.evidence->over_usual_floor(state.base.prediction).all;
  Left left{over > rules::floor_gate || over_usual > rules::slow_noise, std::max(over, over_usual), {}};
  if (left.more_than_noise)
    left.looked_at = state.unless_stopped(
        [&] { left.search = find_structures(*state.evidence, state.base.prediction, state.context.threads); });
  return left;
}

/// A structure that no effect describes explains more than the effects did: what they took away was part of it.
void withdraw(SearchState& state) {
  for (auto& c : state.d.candidates)
    if (c.claimed) {
      c.claimed = false;
      c.reason = "withdrawn: " + state.d.structure->sentence + ", more than this effect takes away";
    }
  state.d.steps.clear();
  state.current = state.base;
  state.settle(state.current);
}

/// Read once, here, and used for nothing but the report.
void test_recordings(SearchState& state) {
  const auto test = state.base_model->recordings(Role::test);
  if (test.empty()) return;
  const Prediction p = predicted(state.context, state.current, test);
  if (!p.ok) return;
  state.evidence->add_test(state.d.final_error, p);
}

/// What a steady line cannot follow is found anew in each recording, and is no evidence of anything else.
void tell_wandering(SearchState& state) {
  const auto rms = state.evidence->wandering(state.current.prediction);
  for (std::size_t o = 0; o < rms.size(); ++o) {
    if (rms[o] < state.evidence->noise().outputs[o].white) continue;
    const Unit& unit = state.base_model->output_unit(static_cast<int>(o));
    state.d.warnings.push_back(fmt::format(
        "the mains is another one in each recording: its amplitude and phase were followed there, every two seconds "
        "where rows suffice: {} rms of {} on recordings not used for the fit. A diagram holds one steady line only: "
        "from its file alone the error is that much larger, and nothing else was looked for there",
        size_text(rms[o], unit), state.base_model->outputs()[o]));
  }
}

void tell_noise(SearchState& state) {
  state.d.noise_guessed = !state.evidence->noise_known();
  for (std::size_t o = 0; o < state.base_model->outputs().size(); ++o) {
    const auto& n = state.evidence->noise().outputs[o];
    JudgedNoise told;
    told.output = state.base_model->outputs()[o];
    told.unit = state.base_model->output_unit(static_cast<int>(o));
    told.white = n.white;
    told.one_over_f = n.one_over_f;
    told.origin = to_text(n.source);
    told.remark = n.remark;
    state.d.noise.push_back(std::move(told));
  }
}

/// What was found early moved on beside what came later: what is told of it are the numbers of the last model.
void take_final_summaries(SearchState& state) {
  auto& steps = state.d.steps;
  for (std::size_t i = 0; i < state.current.placed.size(); ++i) {
    const PlacedEffect& s = state.current.placed[i];
    const auto is = [&](const FoundStep& f) {
      return f.winner.effect == s.effect->id && f.winner.place == s.place.where();
    };
    const auto step = std::find_if(steps.begin(), steps.end(), is);
    if (step == steps.end()) continue;
    const auto at = circumstances_on(state, state.current, {s.place});
    if (auto told = summary_of(state.current, i, at.front()); !told.empty()) step->winner.summary = std::move(told);
  }
}

void tell_final_values(SearchState& state) {
  state.unless_stopped([&] { take_final_summaries(state); });
  for (auto& step : state.d.steps) step.sentence = step_sentence(step, state.effects.get(step.winner.effect));
}

}  // namespace

namespace {

/// A structure that is told of what the user's model leaves.
struct OfBase {
  std::optional<Structure> told;
  bool in_place_of_effects = false;
};

/// In place of the effects, if it explains more of the recordings that judge than they do, else of all; or where none
/// was found.
OfBase structure_of_base(SearchState& state, const Left& left) {
  const bool none_found = state.d.steps.empty();
  JudgedSearch judged{left.search, Where::validation, {}}, all{{}, Where::all_recordings, {}};
  if (left.structure() != nullptr) judged.requirement = beside_effects(state, *left.structure(), Where::validation);
  if (!wins(judged) && (left.more_than_noise || !none_found)) all = in_all_recordings(state);
  const std::string more =
      none_found ? "more than chance, and no effect was found" : "takes more away than the effects that were found";
  const bool alone = !wins(judged) && !wins(all) && none_found && left.is_unexplained() && left.told();
  if (alone) judged.requirement = {rules::claim_fall, ""};
  keep_structures(state.d, judged, LeftBy::base, wins(judged) ? more : "");
  keep_structures(state.d, all, LeftBy::base, wins(all) ? more : "");
  if (wins(judged)) return {*judged.search.winner(), !alone};
  if (wins(all)) return {*all.search.winner(), true};
  return {};
}

/// By the score of whole models.
OfBase ahead_by_score(SearchState& state) {
  if (!state.ahead_of_effects) return {};
  const auto& [search, by] = *state.ahead_of_effects;
  keep_structures(state.d, {search, Where::all_recordings, {}}, LeftBy::base,
                  fmt::format("its score is {:.0f} above that of the effects that were found", by));
  return {*search.winner(), true};
}

/// What stands out of what the effects leave.
void structure_behind_effects(SearchState& state) {
  JudgedSearch rest{
      find_structures(*state.evidence, state.current.prediction, state.context.threads), Where::validation, {}};
  const Structure* s = rest.search.winner();
  if (s != nullptr) rest.requirement = to_stand_out(*s);
  const bool told = wins(rest);
  if (told) state.d.structure = *s;
  keep_structures(state.d, rest, LeftBy::effects, told ? "stands out of what the effects leave" : "");
}

}  // namespace

bool leaves_something_unexplained(const SearchState& state) {
  const Left left = left_by_base(state);
  return left.is_unexplained() || (left.more_than_noise && wins(in_all_recordings(state)));
}

void conclude(SearchState& state) {
  const StopScope to_its_end(nullptr);  // but for what can be left out
  state.progress("what is left", 0.97);
  state.settle(state.current);
  state.d.base = state.evidence->error(state.base.prediction);
  state.d.broken_off = state.d.broken_off || state.stopped();
  state.closing = true;
  if (state.d.broken_off && !state.by_score) {
    unless_it_fails(state, [&] { return exchange_for_what_they_hold(state, 0.97), true; });
    unless_it_fails(state, [&] { return leave_out_idle(state), true; });
  }
  const double floor = state.current.error_of.over_floor();
  const bool is_settled = state.by_score && !state.d.steps.empty();  // by the score: see structure_term.h
  const Left left = is_settled ? Left{} : left_by_base(state);
  const OfBase of_base = is_settled ? ahead_by_score(state) : structure_of_base(state, left);
  state.d.structure = of_base.told;
  if (of_base.in_place_of_effects) {
    state.d.verdict = Verdict::unexplained;
    withdraw(state);
  } else if (state.d.steps.empty()) {
    // Of a search by models that was broken off nobody knows what else would have explained what is left.
    const bool open = left.is_unexplained() || (state.by_score && state.d.broken_off && left.more_than_noise);
    state.d.verdict = open ? Verdict::unexplained : Verdict::adequate;
  } else {
    const bool tied = std::all_of(state.d.steps.begin(), state.d.steps.end(), leaves_the_question_open);
    state.d.verdict = tied ? Verdict::not_distinguishable : Verdict::missing_effect;
    if (floor > rules::floor_gate) state.unless_stopped([&] { structure_behind_effects(state); });
  }
  state.d.remainder =
      state.current.error_of.over_floor() > rules::floor_gate ? Remainder::structured : Remainder::noise;
  for (const auto& s : state.d.steps)
    if (s.experiment && s.experiment_would_tell &&
        (!state.d.experiment || s.experiment->separation > state.d.experiment->separation))
      state.d.experiment = s.experiment;
  state.d.final_diagram = state.current.diagram;
  state.d.final_error = state.current.error_of;
  state.d.final_prediction = state.current.prediction;
  add_zeros(*state.base_model, state.evidence->judge(), state.d.final_prediction);
  state.unless_stopped([&] { test_recordings(state); });
  if (!state.by_score) state.unless_stopped([&] { tell_other_ways(state); });
  if (!state.by_score) tell_other_numbers(state);
  tell_noise(state);
  tell_wandering(state);
  tell_final_values(state);
  put_into_words(state.d, *state.data);
  state.progress("done", 1);
}

}  // namespace hysteron
