// Decides what a discovery starts from: the user's own model, fitted.
#include "discover/models/own_resonances.h"
#include "discover/search/between_samples.h"
#include "discover/search/search_state.h"
#include "engine/diagram/error.h"
#include "fit/estimate/beginning.h"
#include "fit/estimate/starts.h"

namespace hysteron {

namespace {

/// The user's model with the numbers that it has.
CandidateModel as_written(const SearchState& state, const Prediction& prediction) {
  CandidateModel c;
  c.diagram = state.user;
  c.program = state.base_model->program_pointer();
  c.prediction = prediction;
  c.ok = prediction.ok;
  c.error = prediction.error;
  return c;
}

/// Recordings that begin elsewhere than the model: what they leave there no effect explains.
void tell_beginnings(SearchState& state) {
  const DataModel& model = *state.base_model;
  Trial values;
  for (const auto& v : state.base.fit.values) {
    const auto& path = state.base.program->parameters[static_cast<std::size_t>(v.parameter)].path;
    values.push_back({parameter_index(model.program(), path), v.value, v.recording});
  }
  for (const auto& b :
       begin_elsewhere(model, state.evidence->noise(), state.base.prediction, values, state.evidence->recordings()))
    state.d.warnings.push_back(to_text(model, b));
}

}  // namespace

void fit_base(SearchState& state) {
  state.progress("the model as it is", 0);
  for (const auto& id : state.options.only) state.effects.get(id);
  state.base_model = std::make_unique<DataModel>(compile(state.user, state.registry), state.data);
  if (state.base_model->recordings(Role::train).empty() || state.base_model->recordings(Role::validate).empty())
    fail("no_validation", state.data->file.empty() ? "recordings" : state.data->file,
         "discovery fits on train recordings and judges on validate recordings; one of the two is missing",
         "give at least one recording the role \"train\" and one the role \"validate\", or name a single CSV: it is "
         "cut in time");
  state.evidence = std::make_unique<Evidence>(*state.base_model);
  state.context.evidence = state.evidence.get();
  state.context.row_tolerance =
      row_tolerance(*state.base_model, state.evidence->noise(), state.options.looser * rules::of_noise);
  // Without the user's model there is nothing to tell: nothing but the caller's own stop ends this.
  improve_starts(*state.base_model, state.evidence->judge(), {}, state.evidence->recordings());
  const Prediction as_given = state.base_model->predict({}, state.evidence->recordings());
  const bool any_free = !free_parameters(state.base_model->program(), state.context.free_paths).empty();
  const bool to_its_end = state.unless_stopped(
      [&] { state.current = base_model(state.context, state.user, any_free ? Effort::full : Effort::final); });
  if (!to_its_end) {
    state.current = as_written(state, as_given);
    if (any_free)
      state.d.warnings.push_back(
          "the search was broken off before the free numbers of the model were found: they stand as they are written");
  }
  if (!state.current.ok)
    fail_numerics("base_failed", state.user.title,
                  "the diagram cannot be simulated on these recordings: " + state.current.error,
                  "run `hysteron compare` or `hysteron run` on it and look at the first recording");
  state.settle(state.current);
  // Free numbers were fitted by the noise of the data sheet: every candidate, fitted by that of the residual, would be
  // credited with what they gain by it.
  if (any_free && to_its_end) {
    CandidateModel again;
    state.unless_stopped([&] { again = refit(state.context, state.current, Effort::final); });
    for (auto& e : again.fit.estimates)  // they began where the user has them
      for (const auto& first : state.current.fit.estimates)
        if (first.path == e.path && first.recording == e.recording) e.start = first.start;
    if (again.ok) state.current = std::move(again);
    state.settle(state.current);
  }
  state.base = state.current;
  state.own_resonances = own_resonances(*state.base.program);
  if (as_given.ok) state.d.as_given = state.evidence->error(as_given);
  state.d.base = state.current.error_of;
  state.d.base_parameters = found_parameters(state.current, {});
  state.d.base_diagram = state.current.diagram;
  state.d.data_remarks = state.data->remarks;
  for (const auto& r : state.base_model->remarks()) state.d.data_remarks.push_back(r);
  tell_smooth_inputs(state);
  state.unless_stopped([&] { tell_beginnings(state); });
}

}  // namespace hysteron
