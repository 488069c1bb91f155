#include "discover/selection/null_model.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "discover/models/fit_candidate_model.h"
#include "discover/search/held_numbers.h"

namespace hysteron {
namespace {

constexpr std::size_t most_numbers = 60;

double squares_over(const LeftSums& left, const LeftSums& than) {
  double sum = 0;
  for (std::size_t k = 0; k < left.size(); ++k)
    if (than[k].all() > 0) sum += left[k].all() / than[k].all();
  return sum / static_cast<double>(left.size());
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Recordings of which nobody says where they begin, by name.
std::vector<std::string> without_stated_start(const DataSet& data) {
  std::vector<std::string> names;
  for (const auto& r : data.recordings)
    if (!r.start_is_stated && r.at_rest && r.role != Role::test) names.push_back(r.name);
  return names;
}

DataSet with_starts(const DataSet& data, const std::vector<std::string>& moving) {
  Discovery some_move;
  some_move.found_starts = moving;
  return as_found(data, some_move);
}

/// What this model says with these numbers from rest, but for the recordings named.
Prediction from_rest(const SearchState& free, const DataSet& given, const TableModel& model,
                     const std::vector<std::string>& moving) {
  FitContext context = free.context;
  context.data = std::make_shared<const DataSet>(with_starts(given, moving));
  const auto program = compile(model.model.diagram, free.registry);
  DataModel data_model = searched_model(context, program, Effort::full);
  return data_model.predict({}, free.evidence->recordings());
}

/// Schwarz's price of the states of a recording whose start is free, in its own witnesses.
double price_of_start(const DataModel& model, const BlockScore& score, int recording) {
  const auto states = static_cast<double>(model.free_initial_states().size());
  return 0.5 * states * std::log(std::max(score.n_eff(recording), 2.0));
}

/// Of the recordings that may move, those that cannot rest (an integrator whose input is not zero), and those whose
/// free start explains more than its states cost.
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
  for (const int r : free.evidence->recordings()) {
    const std::string& name = model.recording(r).name;
    if (contains(moving, name)) continue;
    const double gain = score.fit_of(best.left, r) - score.fit_of(left, r);
    if (gain > price_of_start(model, score, r)) moving.push_back(name);
  }
  return moving;
}

/// A model that was found, fitted anew where these recordings begin anywhere.
struct BeganAnew {
  BeganAnew(const FitSetting& setting, const TableModel& model, const std::vector<std::string>& moving)
      : free(setting.state.user, with_starts(*setting.state.data, moving), setting.state.registry,
             setting.state.effects, setting.state.options) {
    fit_base(free);
    FitSetting anew(free, setting.numbers);
    anew.score = setting.score;
    fitted = refitted(anew, free.context, model, model.numbers);
  }
  SearchState free;
  TableModel fitted;
};

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
  const auto may_move = without_stated_start(data);
  if (may_move.empty()) return {};
  SearchState free(diagram, with_starts(data, may_move), registry, effects, options);
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

std::vector<std::string> begin_in_motion_beside(const FitSetting& setting, const TableModel& found,
                                                const TableModel& than, double more) {
  const SearchState& state = setting.state;
  const auto may_move = without_stated_start(*state.data);
  if (may_move.empty() || found.model.program->n_x == 0) return {};
  const BeganAnew all(setting, found, may_move);
  if (!all.fitted.ok() || all.free.base_model->free_initial_states().empty()) return {};
  const auto moving = worth_a_start(all.free, *state.data, all.fitted);
  if (moving.empty()) return {};
  const BeganAnew some(setting, found, moving);
  if (!some.fitted.ok()) return {};
  const BlockScore score(*some.free.evidence, {some.fitted.left, than.left});
  double gain = score_of(score, some.fitted) - score_of(score, than);
  for (const int r : some.free.evidence->recordings())
    if (contains(moving, some.free.base_model->recording(r).name))
      gain -= price_of_start(*some.free.base_model, score, r);
  return gain > more ? moving : std::vector<std::string>{};
}

}  // namespace hysteron
