#include "discover/selection/null_model.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "discover/models/fit_candidate_model.h"
#include "discover/search/held_numbers.h"
#include "fit/estimate/beginning.h"

namespace hysteron {
namespace {

constexpr std::size_t most_numbers = 60;

double squares_over(const LeftSums& left, const LeftSums& than) {
  double sum = 0;
  for (std::size_t k = 0; k < left.size(); ++k)
    if (than[k].all() > 0) sum += left[k].all() / than[k].all();
  return sum / static_cast<double>(left.size());
}

/// Recordings of which nobody says where they begin, by name.
std::vector<std::string> without_stated_start(const DataSet& data) {
  std::vector<std::string> names;
  for (const auto& r : data.recordings)
    if (!r.start_is_stated && r.at_rest && r.role != Role::test) names.push_back(r.name);
  return names;
}

/// What this model says with these numbers from rest, but for the recordings named.
Prediction from_rest(const SearchState& free, const DataSet& given, const TableModel& model,
                     const std::vector<std::string>& moving) {
  Discovery some_move;
  some_move.found_starts = moving;
  FitContext context = free.context;
  context.data = std::make_shared<const DataSet>(as_found(given, some_move));
  const auto program = compile(model.model.diagram, free.registry);
  DataModel data_model = searched_model(context, program, Effort::full);
  return data_model.predict({}, free.evidence->recordings());
}

/// Of the recordings that may move, those that cannot rest (an integrator whose input is not zero), and those whose
/// free start explains more than its states cost: by Schwarz's price in the recording's own witnesses.
std::vector<std::string> worth_a_start(const SearchState& free, const DataSet& given, const TableModel& best) {
  const DataModel& model = *free.base_model;
  std::vector<std::string> moving;
  Prediction rest = from_rest(free, given, best, moving);
  if (!rest.ok) {
    for (const int r : free.evidence->recordings())
      if (rest.y[static_cast<std::size_t>(r)].empty()) moving.push_back(model.recording(r).name);
    rest = from_rest(free, given, best, moving);
  }
  if (!rest.ok) return {};
  const BlockScore score(*free.evidence, {best.left});
  const LeftSums left = left_sums(left_rows(*free.evidence, rest, best.weights));
  const auto states = static_cast<double>(model.free_initial_states().size());
  for (const int r : free.evidence->recordings()) {
    const std::string& name = model.recording(r).name;
    if (std::find(moving.begin(), moving.end(), name) != moving.end()) continue;
    const double gain = score.fit_of(best.left, r) - score.fit_of(left, r);
    const double price = 0.5 * states * std::log(std::max(score.n_eff(r), 2.0));
    if (gain > price) moving.push_back(name);
  }
  return moving;
}

}  // namespace

const TableModel& Nulls::better(const BlockScore& score) const {
  return let_go.ok() && score_of(score, let_go) > score_of(score, written) ? let_go : written;
}

const TableModel& Nulls::best() const {
  return let_go.ok() && squares_over(let_go.left, written.left) < 1 ? let_go : written;
}

std::map<std::string, double> numbers_not_exact(const SearchState& state) {
  if (state.options.numbers_are_exact) return {};
  auto numbers = held_numbers(state);
  if (numbers.size() > most_numbers) numbers.clear();
  return numbers;
}

Nulls fit_nulls(const FitSetting& setting, int renewals) {
  Nulls nulls;
  nulls.written = measured(setting, setting.state.base, Numbers::written, setting.state.evidence->noise(), {});
  if (TableModel again = refitted(setting, setting.state.context, nulls.written, Numbers::written, renewals);
      again.ok())
    nulls.written = std::move(again);
  if (!setting.numbers.empty())
    nulls.let_go = refitted(setting, setting.state.context, nulls.written, Numbers::let_go, renewals);
  return nulls;
}

std::vector<std::string> begin_in_motion(const Diagram& diagram, const DataSet& data, const Registry& registry,
                                         const Effects& effects, const DiscoverOptions& options) {
  Discovery may_move;
  may_move.found_starts = without_stated_start(data);
  if (may_move.found_starts.empty()) return {};
  SearchState free(diagram, as_found(data, may_move), registry, effects, options);
  fit_base(free);
  if (free.base_model->free_initial_states().empty()) return {};
  std::vector<std::string> moving;
  free.unless_stopped([&] {
    constexpr int renewals = 4;  // beside what is found it is looked at again
    const Nulls nulls = fit_nulls(FitSetting(free, numbers_not_exact(free)), renewals);
    moving = worth_a_start(free, data, nulls.best());
  });
  return moving;
}

std::vector<std::string> begin_in_motion_beside(const FitSetting& setting, const TableModel& found) {
  const SearchState& state = setting.state;
  const auto may_move = without_stated_start(*state.data);
  if (may_move.empty()) return {};
  const NoiseModel weights = weights_of(setting, found);
  const FitContext fits = context_for(setting, state.context, weights, found.numbers);
  const DataModel model = searched_model(fits, found.model.program, Effort::full);
  Trial values;
  for (const auto& v : found.model.of_recordings)
    values.push_back({parameter_index(*found.model.program, v.path), v.value, v.recording});
  std::vector<std::string> moving;
  for (const auto& b : begin_elsewhere(model, weights, found.model.prediction, values, state.evidence->recordings()))
    if (const auto& name = model.recording(b.recording).name;
        std::find(may_move.begin(), may_move.end(), name) != may_move.end())
      moving.push_back(name);
  return moving;
}

}  // namespace hysteron
