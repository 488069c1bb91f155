// Decides what a discovery starts from: the user's own model, fitted, and how its inputs move between samples.
#include <fmt/format.h>

#include "discover/books.h"
#include "discover/wiring.h"
#include "engine/error.h"

namespace hysteron {
namespace {

/// How an input moves between its samples is the user's word. Where the other way fits better the recordings are
/// asked to speak: it is half a sample of delay, which would be sold as an effect.
void tell_between_samples(Books& books) {
  for (const auto& input : books.base_model->program().input_names) {
    if (books.stopped()) return;
    const auto note = books.data->notes.find(input);
    if (note == books.data->notes.end()) continue;
    DataSet other = *books.data;
    auto& between = other.notes[input].between;
    between = between == Between::hold ? Between::linear : Between::hold;
    Workshop shop = books.shop;
    shop.data = std::make_shared<const DataSet>(std::move(other));
    const Contender c = base_contender(shop, books.user, Effort::full);
    if (!c.ok) continue;
    const ModelError& was = books.base.error_of;
    const bool better = was.evidence_train - c.error_of.evidence_train > rules::claim_fall &&
                        was.evidence_validate - c.error_of.evidence_validate > rules::claim_fall &&
                        c.error_of.excess_validate() < (1 - rules::structure_share) * was.excess_validate();
    if (!better) continue;
    const bool held = note->second.between == Between::hold;
    books.d.warnings.push_back(fmt::format(
        "{} {}, not as the data set says: the error of the model as it is would be {:.3g} % instead of {:.3g} %. A "
        "dead time of half a sample looks the same.",
        input, held ? "moves linearly between its samples" : "is held between its samples",
        100 * c.error_of.nrmse_validate, 100 * was.nrmse_validate));
  }
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
  const Prediction as_given = books.base_model->predict({}, books.evidence->recordings());
  books.current = base_contender(books.shop, books.user, Effort::final);
  if (!books.current.ok)
    fail_numerics("base_failed", books.user.title,
                  "the diagram cannot be simulated on these recordings: " + books.current.error,
                  "run `hysteron compare` or `hysteron run` on it and look at the first recording");
  books.settle(books.current);
  books.base = books.current;
  if (as_given.ok) books.d.as_given = books.evidence->error(as_given);
  books.d.base = books.current.error_of;
  books.d.base_parameters = found_parameters(books.current, {});
  books.d.base_diagram = books.current.diagram;
  books.d.data_remarks = books.data->remarks;
  for (const auto& r : books.base_model->remarks()) books.d.data_remarks.push_back(r);
  tell_between_samples(books);
}

}  // namespace hysteron
