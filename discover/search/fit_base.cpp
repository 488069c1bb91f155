// Decides what a discovery starts from: the user's own model, fitted.
#include "discover/models/own_resonances.h"
#include "discover/search/between_samples.h"
#include "discover/search/books.h"
#include "engine/diagram/error.h"
#include "fit/estimate/beginning.h"
#include "fit/estimate/starts.h"

namespace hysteron {

namespace {

/// The user's model with the numbers that it has.
Contender as_written(const Books& books, const Prediction& prediction) {
  Contender c;
  c.diagram = books.user;
  c.program = books.base_model->program_pointer();
  c.prediction = prediction;
  c.ok = prediction.ok;
  c.error = prediction.error;
  return c;
}

/// Recordings that begin elsewhere than the model: what they leave there no effect explains.
void tell_beginnings(Books& books) {
  const DataModel& model = *books.base_model;
  Trial values;
  for (const auto& v : books.base.fit.values) {
    const auto& path = books.base.program->parameters[static_cast<std::size_t>(v.parameter)].path;
    values.push_back({parameter_index(model.program(), path), v.value, v.recording});
  }
  for (const auto& b :
       begin_elsewhere(model, books.evidence->noise(), books.base.prediction, values, books.evidence->recordings()))
    books.d.warnings.push_back(to_text(model, b));
}

}  // namespace

void fit_base(Books& books) {
  books.progress("the model as it is", 0);
  for (const auto& id : books.options.only) books.effects.get(id);
  books.base_model = std::make_unique<DataModel>(compile(books.user, books.registry), books.data);
  if (books.base_model->recordings(Role::train).empty() || books.base_model->recordings(Role::validate).empty())
    fail("no_validation", books.data->file.empty() ? "recordings" : books.data->file,
         "discovery fits on train recordings and judges on validate recordings; one of the two is missing",
         "give at least one recording the role \"train\" and one the role \"validate\", or name a single CSV: it is "
         "cut in time");
  books.evidence = std::make_unique<Evidence>(*books.base_model);
  books.shop.evidence = books.evidence.get();
  books.shop.row_tolerance =
      row_tolerance(*books.base_model, books.evidence->noise(), books.options.looser * rules::of_noise);
  // Without the user's model there is nothing to tell: nothing but the caller's own stop ends this.
  improve_starts(*books.base_model, books.evidence->judge(), {}, books.evidence->recordings());
  const Prediction as_given = books.base_model->predict({}, books.evidence->recordings());
  const bool any_free = !free_parameters(books.base_model->program(), books.shop.free_paths).empty();
  const bool to_its_end = books.unless_stopped(
      [&] { books.current = base_contender(books.shop, books.user, any_free ? Effort::full : Effort::final); });
  if (!to_its_end) {
    books.current = as_written(books, as_given);
    if (any_free)
      books.d.warnings.push_back(
          "the search was broken off before the free numbers of the model were found: they stand as they are written");
  }
  if (!books.current.ok)
    fail_numerics("base_failed", books.user.title,
                  "the diagram cannot be simulated on these recordings: " + books.current.error,
                  "run `hysteron compare` or `hysteron run` on it and look at the first recording");
  books.settle(books.current);
  // Free numbers were fitted by the noise of the data sheet: every candidate, fitted by that of the residual, would be
  // credited with what they gain by it.
  if (any_free && to_its_end) {
    Contender again;
    books.unless_stopped([&] { again = refit(books.shop, books.current, Effort::final); });
    for (auto& e : again.fit.estimates)  // they began where the user has them
      for (const auto& first : books.current.fit.estimates)
        if (first.path == e.path && first.recording == e.recording) e.start = first.start;
    if (again.ok) books.current = std::move(again);
    books.settle(books.current);
  }
  books.base = books.current;
  books.own_resonances = own_resonances(*books.base.program);
  if (as_given.ok) books.d.as_given = books.evidence->error(as_given);
  books.d.base = books.current.error_of;
  books.d.base_parameters = found_parameters(books.current, {});
  books.d.base_diagram = books.current.diagram;
  books.d.data_remarks = books.data->remarks;
  for (const auto& r : books.base_model->remarks()) books.d.data_remarks.push_back(r);
  tell_smooth_inputs(books);
  books.unless_stopped([&] { tell_beginnings(books); });
}

}  // namespace hysteron
