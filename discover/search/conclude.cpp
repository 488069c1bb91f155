// Decides the verdict of a discovery: effects, a generic structure that is ahead of them by the score, or nothing;
// where nothing was found, whether a structure is left; and what is told of what is left.
#include <fmt/format.h>

#include <algorithm>

#include "discover/search/search_state.h"
#include "discover/search/structures_tried.h"
#include "engine/diagram/stop.h"
#include "fit/signals/unit_words.h"

namespace hysteron {
namespace {

std::string holds_too_little(const Structure& s) {
  return fmt::format("holds {}, and not the {} of what stands above the noise that are asked",
                     percent(std::max(0.0, s.share_removed)), percent(rules::structure_share));
}

/// What it has to take away to be told where no effect was found.
Requirement to_be_told(const Structure& s, Where where) {
  if (!s.explains()) return {{}, "bursts only say when, and explain nothing"};
  if (!(s.share_removed > rules::structure_share)) return {{}, holds_too_little(s)};
  return {rules::claim_fall, over(s.fall, where) > rules::claim_fall ? "" : "no more than chance"};
}

/// In all recordings, where one is left unexplained: those that judge may be too short to show a slow pump.
JudgedSearch in_all_recordings(const SearchState& state) {
  JudgedSearch judged{{}, Where::all_recordings, {}};
  if (state.evidence->over_usual_floor(state.current.prediction).one <= rules::floor_gate) return judged;
  state.unless_stopped([&] {
    judged.search =
        find_structures(*state.evidence, state.base.prediction, state.context.threads, Where::all_recordings);
  });
  if (const Structure* s = judged.search.winner()) judged.requirement = to_be_told(*s, Where::all_recordings);
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
        "where rows suffice: {} rms of {} on {}. A diagram holds one steady line only: "
        "from its file alone the error is that much larger, and nothing else was looked for there",
        size_text(rms[o], unit), state.base_model->outputs()[o], judged_on(state.d)));
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
  for (auto& step : state.d.steps)
    step.sentence = step_sentence(step, state.effects.get(step.winner.effect), judged_on(state.d));
}

/// Where no effect was found: a structure of what the user's model leaves in recordings that judge, else in all.
std::optional<Structure> structure_of_base(SearchState& state, const Left& left) {
  JudgedSearch judged{left.search, Where::validation, {}}, all{{}, Where::all_recordings, {}};
  if (left.structure() != nullptr) judged.requirement = to_be_told(*left.structure(), Where::validation);
  if (!wins(judged) && left.more_than_noise) all = in_all_recordings(state);
  if (!wins(judged) && !wins(all) && left.is_unexplained() && left.told()) judged.requirement = {rules::claim_fall, ""};
  const std::string more = "more than chance, and no effect was found";
  keep_structures(state.d, judged, LeftBy::base, wins(judged) ? more : "");
  keep_structures(state.d, all, LeftBy::base, wins(all) ? more : "");
  if (wins(judged)) return *judged.search.winner();
  if (wins(all)) return *all.search.winner();
  return std::nullopt;
}

/// By the score of whole models.
std::optional<Structure> ahead_of_effects(SearchState& state) {
  if (!state.structure) return std::nullopt;
  const auto& [judged, by] = *state.structure;
  const bool told = wins(judged);
  keep_structures(state.d, judged, LeftBy::base,
                  told ? fmt::format("its score is {:.0f} above that of the effects that were found", by) : "");
  return told ? std::optional(*judged.search.winner()) : std::nullopt;
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

/// Something else explains the step as well, and an experiment of this bench would tell. What only another instrument
/// tells after many recordings is missing under either name.
bool leaves_the_question_open(const FoundStep& step) {
  return !step.ties.empty() && step.experiment_would_tell && !(step.experiment && step.experiment->another_instrument);
}

/// Verdict and structure.
void judge_what_was_found(SearchState& state) {
  if (state.d.steps.empty()) {
    const Left left = left_by_base(state);
    state.d.structure = structure_of_base(state, left);
    // Of a search that was broken off nobody knows what else would have explained what is left.
    const bool open = state.d.structure || left.is_unexplained() || (state.d.broken_off && left.more_than_noise);
    state.d.verdict = open ? Verdict::unexplained : Verdict::adequate;
    return;
  }
  state.d.structure = ahead_of_effects(state);
  if (state.d.structure) {
    state.d.verdict = Verdict::unexplained;
    withdraw(state);
    return;
  }
  const bool tied = std::all_of(state.d.steps.begin(), state.d.steps.end(), leaves_the_question_open);
  state.d.verdict = tied ? Verdict::not_distinguishable : Verdict::missing_effect;
  if (state.current.error_of.over_floor() > rules::floor_gate)
    state.unless_stopped([&] { structure_behind_effects(state); });
}

}  // namespace

void conclude(SearchState& state) {
  const StopScope to_its_end(nullptr);  // but for what can be left out
  state.progress("what is left", 0.97);
  state.settle(state.current);
  state.d.base = state.evidence->error(state.base.prediction);
  state.d.broken_off = state.d.broken_off || state.stopped();
  state.closing = true;
  judge_what_was_found(state);
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
  tell_noise(state);
  tell_wandering(state);
  tell_final_values(state);
  state.d.broken_off = state.d.broken_off || state.stopped();  // of what is left out meanwhile it is said, too
  put_into_words(state.d, *state.data);
  state.progress("done", 1);
}

}  // namespace hysteron
