#include "discover/selection/null_model.h"

#include <cmath>

#include "discover/models/fit_contender.h"
#include "discover/search/nominal_parameters.h"

namespace hysteron {
namespace {

constexpr std::size_t most_numbers = 60;

double squares_over(const LeftSums& left, const LeftSums& than) {
  double sum = 0;
  for (std::size_t k = 0; k < left.size(); ++k)
    if (than[k].all() > 0) sum += left[k].all() / than[k].all();
  return sum / static_cast<double>(left.size());
}

DataSet with_free_starts(DataSet data, const std::vector<std::string>* only) {
  for (auto& r : data.recordings) {
    if (r.start_is_stated || !r.at_rest || r.role == Role::test) continue;
    if (only != nullptr && std::find(only->begin(), only->end(), r.name) == only->end()) continue;
    r.at_rest = false;
    r.initial_per_recording = true;
  }
  return data;
}

bool any_start_unstated(const DataSet& data) {
  return std::any_of(data.recordings.begin(), data.recordings.end(),
                     [](const Recording& r) { return !r.start_is_stated && r.at_rest && r.role != Role::test; });
}

}  // namespace

const TableModel& Nulls::better(const BlockScore& score) const {
  return let_go.ok() && score_of(score, let_go) > score_of(score, written) ? let_go : written;
}

const TableModel& Nulls::best() const {
  return let_go.ok() && squares_over(let_go.left, written.left) < 1 ? let_go : written;
}

std::map<std::string, double> numbers_not_exact(const Books& books) {
  if (books.options.numbers_are_exact) return {};
  auto numbers = held_numbers(books);
  if (numbers.size() > most_numbers) numbers.clear();
  return numbers;
}

Nulls fit_nulls(const FitSetting& setting, int renewals) {
  Nulls nulls;
  nulls.written = measured(setting, setting.books.base, Numbers::written, 0);
  if (TableModel again = refitted(setting, setting.books.shop, nulls.written, Numbers::written, renewals); again.ok())
    nulls.written = std::move(again);
  if (!setting.numbers.empty())
    nulls.let_go = refitted(setting, setting.books.shop, nulls.written, Numbers::let_go, renewals);
  return nulls;
}

std::vector<std::string> begin_in_motion(const Diagram& diagram, const DataSet& data, const Registry& registry,
                                         const Effects& effects, const DiscoverOptions& options) {
  std::vector<std::string> moving;
  if (!any_start_unstated(data)) return moving;
  Books free(diagram, with_free_starts(data, nullptr), registry, effects, options);
  fit_base(free);
  const auto states = free.base_model->free_initial_states().size();
  if (states == 0) return moving;
  const FitSetting setting{free, numbers_not_exact(free)};
  constexpr int renewals = 4;  // a start that is missing stands out of any model of the rest
  const Nulls nulls = fit_nulls(setting, renewals);
  const TableModel& best = nulls.best();
  const BlockScore score(*free.evidence, left_rows(*free.evidence, best.model.prediction));
  // The same model and numbers from rest.
  Workshop at_rest = free.shop;
  at_rest.data = std::make_shared<const DataSet>(data);
  ProgramPointer fitted = compile(best.model.diagram, registry);
  DataModel from_rest(fitted, at_rest.data, accuracy(at_rest, Effort::full));
  const Prediction rest = from_rest.predict({}, free.evidence->recordings());
  if (!rest.ok) return moving;
  const LeftSums left = left_sums(left_rows(*free.evidence, rest));
  for (const int r : free.evidence->recordings()) {
    const Recording& recording = free.base_model->recording(r);
    if (recording.start_is_stated) continue;
    const double gain = score.fit_of(best.left, r) - score.fit_of(left, r);
    const double price = 0.5 * static_cast<double>(states) * std::log(std::max(score.n_eff(r), 2.0));
    if (gain > price) moving.push_back(recording.name);
  }
  return moving;
}

}  // namespace hysteron
