#include "fit/model/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/diagram/series_cursor.h"
#include "engine/program/names.h"
#include "fit/model/model_content.h"
#include "fit/numerics/threads.h"

namespace hysteron {

/// Each recording has its own workspaces, so who computes it cannot change its numbers.
template <class Job>
void DataModel::Content::side_by_side(std::span<const int> recordings, const Job& job) const {
  options.threads.each(recordings.size(), [&](std::size_t i) { job(recordings[i]); });
}

DataModel::DataModel(ProgramPointer program, std::shared_ptr<const DataSet> data, DataModelOptions options)
    : content_(std::make_unique<Content>()) {
  Content& c = *content_;
  c.program = std::move(program);
  c.data = std::move(data);
  c.options = options;
  check_binding(*c.data, *c.program);
  c.not_exact = options.force_cvode ? "BDF was asked for" : hysteron::why_not_exact(*c.program);
  c.find_outputs();
  c.bound.resize(c.data->recordings.size());
  for (int r = 0; r < n_recordings(); ++r) c.bind(r);
  c.find_free_states();
  c.spans.assign(c.outputs.size(), 0.0);
  for (std::size_t o = 0; o < c.outputs.size(); ++o) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& b : c.bound)
      for (const double y : *b.measured[o]) {
        low = std::min(low, y);
        high = std::max(high, y);
      }
    c.spans[o] = high > low ? high - low : 0;
  }
}
DataModel::~DataModel() = default;
DataModel::DataModel(DataModel&&) noexcept = default;
DataModel& DataModel::operator=(DataModel&&) noexcept = default;

const Program& DataModel::program() const { return *content_->program; }
ProgramPointer DataModel::program_pointer() const { return content_->program; }
const DataSet& DataModel::data() const { return *content_->data; }
int DataModel::threads() const { return content_->options.threads.count(); }
int DataModel::n_recordings() const { return static_cast<int>(content_->data->recordings.size()); }
const Recording& DataModel::recording(int r) const { return content_->data->recordings[static_cast<std::size_t>(r)]; }

std::vector<int> DataModel::recordings(std::span<const Role> roles) const {
  std::vector<int> list;
  for (int r = 0; r < n_recordings(); ++r)
    if (std::find(roles.begin(), roles.end(), recording(r).role) != roles.end()) list.push_back(r);
  return list;
}
std::vector<int> DataModel::recordings(Role role) const { return recordings(std::span<const Role>(&role, 1)); }

const std::vector<std::string>& DataModel::outputs() const { return content_->outputs; }
int DataModel::output_signal(int output) const { return content_->signals[static_cast<std::size_t>(output)]; }
const Unit& DataModel::output_unit(int output) const { return content_->units[static_cast<std::size_t>(output)]; }
bool DataModel::zero_per_recording(int output) const {
  const auto note = data().notes.find(outputs()[static_cast<std::size_t>(output)]);
  return note != data().notes.end() && note->second.zero_per_recording;
}
const Rows& DataModel::measured(int recording, int output) const {
  return *content_->bound[static_cast<std::size_t>(recording)].measured[static_cast<std::size_t>(output)];
}
const Rows& DataModel::times(int recording) const {
  return *content_->bound[static_cast<std::size_t>(recording)].times;
}

Rows DataModel::input(int recording, int input) const { return *shared_input(recording, input); }

RowsPointer DataModel::shared_input(int recording, int input) const {
  const BoundRecording& b = content_->bound[static_cast<std::size_t>(recording)];
  const auto signal = static_cast<std::size_t>(program().input_signals[static_cast<std::size_t>(input)]);
  const auto block = static_cast<std::size_t>(program().signals[signal].block);
  const auto& series = *b.run.series[static_cast<std::size_t>(program().blocks[block].series_index)];
  const auto& columns = this->recording(recording).columns;
  // At its samples it is the column, but for those that come late, move smoothly or are not all judged.
  if (const auto column = columns.find(program().input_names[static_cast<std::size_t>(input)]);
      column != columns.end() && series.v == column->second && series.t == *b.times)
    return {content_->data, &column->second};
  auto rows = std::make_shared<Rows>();
  rows->reserve(b.times->size());
  SeriesCursor cursor(series);
  for (const double t : *b.times) rows->push_back(cursor.value(t, t));
  return rows;
}

int DataModel::main_input() const {
  if (const int known = content_->main_input; known > -2) return known;
  int best = -1;
  double largest = -1;
  for (int i = 0; i < static_cast<int>(program().input_names.size()); ++i) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int r = 0; r < n_recordings(); ++r)
      for (const double u : *shared_input(r, i)) {
        low = std::min(low, u);
        high = std::max(high, u);
      }
    const double size = std::max(std::abs(low), std::abs(high));
    const double motion = size > 0 ? (high - low) / size : 0;
    if (motion > largest) {
      largest = motion;
      best = i;
    }
  }
  content_->main_input = best;
  return best;
}

double DataModel::span(int output) const { return content_->spans[static_cast<std::size_t>(output)]; }
const std::string& DataModel::why_not_exact() const { return content_->not_exact; }
bool DataModel::integrates() const {
  const auto& bound = content_->bound;
  return std::any_of(bound.begin(), bound.end(), [](const auto& b) { return b.advance && b.advance->integrates(); });
}
bool DataModel::goes_by_points() const {
  const auto& bound = content_->bound;
  return std::any_of(bound.begin(), bound.end(),
                     [](const auto& b) { return b.advance && !b.advance->passes_rows(b.run); });
}

Prediction DataModel::predict(std::span<const ParameterValue> values, std::span<const int> recordings,
                              bool with_initial) {
  Content& c = *content_;
  if (!c.substeps_chosen) choose_substeps(values);
  Prediction prediction;
  prediction.y.resize(c.bound.size());
  prediction.initial.resize(c.bound.size());
  prediction.initial_sigma = c.start_sigma;
  std::vector<std::string> errors(c.bound.size());
  const auto predict_recording = [&](int r) {
    c.predict_one(r, values, with_initial, prediction, errors[static_cast<std::size_t>(r)]);
    if (!c.options.keep_workspaces) c.release(c.bound[static_cast<std::size_t>(r)]);
  };
  // The exact advance is quick, and its workspaces are several times what it makes: one after the other.
  if (!c.options.keep_workspaces && c.not_exact.empty())
    std::for_each(recordings.begin(), recordings.end(), predict_recording);
  else
    c.side_by_side(recordings, predict_recording);
  for (const auto& error : errors)
    if (!error.empty() && prediction.ok) {
      prediction.ok = false;
      prediction.error = error;
    }
  return prediction;
}

std::vector<Prediction> DataModel::predict_each(std::span<const Trial> trials, std::span<const int> recordings) {
  Content& c = *content_;
  if (trials.empty()) return {};
  if (!c.substeps_chosen) choose_substeps(trials.front());
  std::vector<Prediction> predictions(trials.size());
  for (auto& prediction : predictions) {
    prediction.y.resize(c.bound.size());
    prediction.initial.resize(c.bound.size());
    prediction.initial_sigma = c.start_sigma;
  }
  std::vector<std::vector<std::string>> errors(c.bound.size());
  c.side_by_side(recordings,
                 [&](int r) { errors[static_cast<std::size_t>(r)] = c.predict_trials(r, trials, predictions); });
  for (const auto& of_recording : errors)
    for (std::size_t i = 0; i < of_recording.size(); ++i)
      if (!of_recording[i].empty() && predictions[i].ok) {
        predictions[i].ok = false;
        predictions[i].error = of_recording[i];
      }
  return predictions;
}

std::vector<double> DataModel::cross_check(std::span<const ParameterValue> values, std::span<const int> recordings) {
  Content& c = *content_;
  std::vector<double> worst(c.outputs.size(), 0.0);
  if (!c.not_exact.empty()) return worst;
  if (!c.substeps_chosen) choose_substeps(values);
  for (const int r : recordings) {
    const auto exact = c.one(r, values, substeps(r), false);
    const auto cvode = c.one(r, values, 1, true);
    for (std::size_t o = 0; o < worst.size(); ++o)
      for (std::size_t i = 0; i < exact[o].size(); ++i)
        worst[o] = std::max(worst[o], std::abs(exact[o][i] - cvode[o][i]) / std::max(c.spans[o], 1e-300));
  }
  return worst;
}

const std::vector<std::string>& DataModel::free_initial_states() const { return content_->free_states; }
bool DataModel::starts_are_searched() const {
  const auto& linear = content_->free_state_is_linear;
  return std::find(linear.begin(), linear.end(), false) != linear.end();
}
const std::vector<double>& DataModel::start_of(int recording) const {
  return content_->bound[static_cast<std::size_t>(recording)].start;
}
void DataModel::begin_at(int recording, std::vector<double> start) {
  content_->bound[static_cast<std::size_t>(recording)].start = std::move(start);
}
void DataModel::hold_starts(std::vector<double> sigma) { content_->start_sigma = std::move(sigma); }
const std::vector<double>& DataModel::start_sigma() const { return content_->start_sigma; }
const std::vector<std::string>& DataModel::remarks() const { return content_->remarks; }
long DataModel::runs() const { return content_->runs; }
long DataModel::failures() const { return content_->failures; }

int parameter_index(const Program& program, const std::string& path) { return named_parameter(program, path); }

}  // namespace hysteron
