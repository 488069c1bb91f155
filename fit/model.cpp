#include "fit/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>

#include "engine/advance.h"
#include "engine/simulate.h"

namespace hysteron {
namespace {

/// Everything of one recording that does not change from trial to trial, and the workspaces that only it uses.
struct Bound {
  Run run;                       ///< inputs bound, parameters as compiled
  std::vector<double> instants;  ///< where the model is evaluated: start of the recording, then all judged instants
  std::vector<std::vector<std::size_t>> at;  ///< [output][judged row]: index into instants
  std::vector<Rows> measured;                ///< [output][judged row]
  Rows times;
  int substeps = 1;
  std::optional<Advance> advance;
  std::vector<std::vector<double>> values;  ///< workspace: [output][instant]
};

/// Blocks whose states may be estimated linearly: linear themselves and up to every output that is measured.
std::vector<bool> linear_to_outputs(const Program& program, const std::vector<int>& signals) {
  const auto n = program.blocks.size();
  std::vector<bool> ok(n, false);
  for (std::size_t b = 0; b < n; ++b) {
    auto reached = program.downstream_of(static_cast<int>(b));
    reached[b] = true;
    ok[b] = true;
    for (std::size_t d = 0; d < n; ++d) {
      if (!reached[d] || program.blocks[d].kernel->declaration.is_linear) continue;
      const auto below = program.downstream_of(static_cast<int>(d));
      for (const int s : signals) {
        const auto block = static_cast<std::size_t>(program.signals[static_cast<std::size_t>(s)].block);
        if (block == d || below[block]) ok[b] = false;
      }
    }
  }
  return ok;
}

}  // namespace

struct DataModel::Content {
  ProgramPointer program;
  std::shared_ptr<const DataSet> data;
  DataModelOptions options;
  std::vector<std::string> outputs;
  std::vector<int> signals;
  std::vector<Unit> units;
  std::vector<Bound> bound;
  std::string not_exact;
  bool substeps_chosen = false;
  bool needs_substeps = false;
  std::vector<std::string> free_states, remarks;
  std::vector<std::size_t> free_state_index;
  std::vector<double> spans;
  std::atomic<long> runs{0}, failures{0};

  void find_outputs();
  void bind(int r);
  void find_free_states();
  Run prepared(const Bound& b, std::span<const ParameterValue> values) const;
  void set_start(const Recording& recording, Run& run, double t) const;
  bool from_rest(const Recording& recording) const;
  void simulate_into(Bound& b, Run run, bool at_rest, int substeps, bool cvode) const;
  std::vector<Rows> rows_of(const Bound& b) const;
  std::vector<Rows> one(int r, std::span<const ParameterValue> values, int substeps, bool cvode);
  void predict_one(int r, std::span<const ParameterValue> values, bool with_initial, Prediction& prediction,
                   std::string& error);
  void predict_initial(int r, std::span<const ParameterValue> values, Prediction& prediction);
  template <class Job>
  void side_by_side(std::span<const int> recordings, const Job& job) const;
};

void DataModel::Content::find_outputs() {
  for (std::size_t i = 0; i < program->output_names.size(); ++i) {
    const auto& name = program->output_names[i];
    const auto there = std::find_if(data->recordings.begin(), data->recordings.end(),
                                    [&](const Recording& r) { return r.columns.count(name) > 0; });
    if (there == data->recordings.end()) continue;
    units.push_back(there->units.at(name));
    outputs.push_back(name);
    signals.push_back(program->output_signals[i]);
  }
}

void DataModel::Content::bind(int r) {
  const Recording& recording = data->recordings[static_cast<std::size_t>(r)];
  Bound& b = bound[static_cast<std::size_t>(r)];
  b.run = start(*program);
  for (const auto& input : program->input_names)
    bind_input(*program, b.run, input, input_series(*data, recording, input));

  const auto first = static_cast<std::ptrdiff_t>(recording.first), last = static_cast<std::ptrdiff_t>(recording.last);
  b.times.assign(recording.t.begin() + first, recording.t.begin() + last);
  b.measured.resize(outputs.size());
  b.at.resize(outputs.size());
  std::vector<std::vector<double>> wanted(outputs.size());
  const double begin = recording.t.front();
  b.instants = {begin};
  for (std::size_t o = 0; o < outputs.size(); ++o) {
    const auto column = recording.columns.find(outputs[o]);
    if (column == recording.columns.end()) continue;
    b.measured[o].assign(column->second.begin() + first, column->second.begin() + last);
    const auto instants = output_instants(*data, recording, outputs[o]);
    for (auto i = first; i < last; ++i) {
      // Before the start the model is where it starts: at rest there.
      wanted[o].push_back(std::max(begin, instants[static_cast<std::size_t>(i)]));
    }
    b.instants.insert(b.instants.end(), wanted[o].begin(), wanted[o].end());
  }
  std::sort(b.instants.begin(), b.instants.end());
  b.instants.erase(std::unique(b.instants.begin(), b.instants.end()), b.instants.end());
  for (std::size_t o = 0; o < outputs.size(); ++o)
    for (const double t : wanted[o])
      b.at[o].push_back(
          static_cast<std::size_t>(std::lower_bound(b.instants.begin(), b.instants.end(), t) - b.instants.begin()));
  if (not_exact.empty()) {
    b.advance.emplace(program, signals);
    needs_substeps = needs_substeps || !b.advance->exact_without_substeps();
  }
}

void DataModel::Content::find_free_states() {
  const bool wanted = std::any_of(data->recordings.begin(), data->recordings.end(),
                                  [](const Recording& r) { return r.initial_per_recording; });
  if (!wanted) return;
  const auto linear = linear_to_outputs(*program, signals);
  for (std::size_t b = 0; b < program->blocks.size(); ++b) {
    const auto& block = program->blocks[b];
    for (int i = 0; i < block.sizes.states; ++i) {
      const auto index = static_cast<std::size_t>(block.x_begin + i);
      if (linear[b]) {
        free_states.push_back(program->state_names[index]);
        free_state_index.push_back(index);
      } else {
        remarks.push_back(
            fmt::format("the start of {} is not estimated per recording, because the path from there to the "
                        "outputs is not linear; it begins in equilibrium",
                        program->state_names[index]));
      }
    }
    if (block.sizes.memory > 0)
      remarks.push_back(fmt::format("the memory of {} begins virgin in every recording", block.path));
  }
}

/// A run with these values; throws where a block refuses them.
Run DataModel::Content::prepared(const Bound& b, std::span<const ParameterValue> values) const {
  Run run = b.run;
  for (const auto& v : values) {
    if (!std::isfinite(v.value))
      fail_numerics("not_finite", program->parameters[static_cast<std::size_t>(v.parameter)].path,
                    "value is not finite", "give a finite start value");
    for (const int slot : program->parameters[static_cast<std::size_t>(v.parameter)].slots)
      run.p[static_cast<std::size_t>(slot)] = v.value;
  }
  // All at once: two values that belong together are never seen half changed.
  prepare(*program, run);
  reset(*program, run);
  return run;
}

bool DataModel::Content::from_rest(const Recording& recording) const {
  return recording.at_rest || (recording.initial_per_recording && recording.initial_values.empty());
}

/// States that the data set gives; the others stay as declared.
void DataModel::Content::set_start(const Recording& recording, Run& run, double t) const {
  run.t = t;
  for (const auto& [name, value] : recording.initial_values) {
    const auto found = std::find(program->state_names.begin(), program->state_names.end(), name);
    if (found == program->state_names.end())
      fail("unknown_state", name,
           fmt::format("recording {} gives a start for \"{}\", which is no state", recording.name, name),
           did_you_mean(name, program->state_names));
    run.x[static_cast<std::size_t>(found - program->state_names.begin())] = value;
  }
}

/// values[output][instant] of one recording.
void DataModel::Content::simulate_into(Bound& b, Run run, bool at_rest, int substeps, bool cvode) const {
  if (b.advance && !cvode) {
    AdvanceOptions o;
    o.substeps = substeps;
    o.at_rest = at_rest;
    (*b.advance)(run, b.instants, o, b.values);
    return;
  }
  SimulateOptions o;
  o.begin = b.instants.front();
  o.until = b.instants.back();
  o.instants = b.instants;
  o.signals = signals;
  o.method = Method::bdf;
  o.relative_tolerance = options.relative_tolerance;
  o.at_rest = at_rest;
  b.values = simulate(*program, std::move(run), o).values;
}

std::vector<Rows> DataModel::Content::rows_of(const Bound& b) const {
  std::vector<Rows> rows(outputs.size());
  for (std::size_t o = 0; o < outputs.size(); ++o) {
    rows[o].reserve(b.at[o].size());
    for (const std::size_t i : b.at[o]) {
      const double y = b.values[o][i];
      if (!std::isfinite(y))
        fail_numerics("diverged", outputs[o], fmt::format("not finite at {} s", b.instants[i]), "narrow the bounds");
      rows[o].push_back(y);
    }
  }
  return rows;
}

std::vector<Rows> DataModel::Content::one(int r, std::span<const ParameterValue> values, int substeps, bool cvode) {
  Bound& b = bound[static_cast<std::size_t>(r)];
  const Recording& recording = data->recordings[static_cast<std::size_t>(r)];
  ++runs;
  Run run = prepared(b, values);
  set_start(recording, run, b.instants.front());
  simulate_into(b, std::move(run), from_rest(recording), substeps, cvode);
  return rows_of(b);
}

void DataModel::Content::predict_initial(int r, std::span<const ParameterValue> values, Prediction& prediction) {
  Bound& b = bound[static_cast<std::size_t>(r)];
  const auto k = static_cast<std::size_t>(r);
  Run rest = prepared(b, values);
  rest.t = b.instants.front();
  settle_at_rest(*program, rest, rest.t);
  const auto response = [&](std::size_t state, double unit) {
    ++runs;
    Run run = rest;
    run.x[state] += unit;
    simulate_into(b, std::move(run), false, b.substeps, options.force_cvode);
    return rows_of(b);
  };
  const auto zero = response(0, 0.0);
  for (const std::size_t state : free_state_index) {
    auto rows = response(state, 1.0);
    for (std::size_t o = 0; o < rows.size(); ++o)
      for (std::size_t i = 0; i < rows[o].size(); ++i) rows[o][i] -= zero[o][i];
    prediction.initial[k].push_back(std::move(rows));
  }
}

/// No exception leaves: a failing simulation is a text.
void DataModel::Content::predict_one(int r, std::span<const ParameterValue> values, bool with_initial,
                                     Prediction& prediction, std::string& error) {
  const auto k = static_cast<std::size_t>(r);
  try {
    prediction.y[k] = one(r, values, bound[k].substeps, options.force_cvode);
    if (with_initial && data->recordings[k].initial_per_recording && !free_states.empty())
      predict_initial(r, values, prediction);
  } catch (const std::exception& e) {
    ++failures;
    error = fmt::format("{}: {}", data->recordings[k].name, e.what());
  }
}

template <class Job>
void DataModel::Content::side_by_side(std::span<const int> recordings, const Job& job) const {
  const auto n = std::min<std::size_t>(static_cast<std::size_t>(std::max(1, options.threads)), recordings.size());
  if (n <= 1) {
    for (const int r : recordings) job(r);
    return;
  }
  // Each recording has its own workspaces, so who computes it cannot change its numbers.
  std::atomic<std::size_t> next{0};
  std::vector<std::jthread> threads;
  for (std::size_t i = 0; i < n; ++i)
    threads.emplace_back([&] {
      for (std::size_t k = next++; k < recordings.size(); k = next++) job(recordings[k]);
    });
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
      for (const double y : b.measured[o]) {
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
  return content_->bound[static_cast<std::size_t>(recording)].measured[static_cast<std::size_t>(output)];
}
const Rows& DataModel::times(int recording) const { return content_->bound[static_cast<std::size_t>(recording)].times; }

Rows DataModel::input(int recording, int input) const {
  const Bound& b = content_->bound[static_cast<std::size_t>(recording)];
  const auto signal = static_cast<std::size_t>(program().input_signals[static_cast<std::size_t>(input)]);
  const auto block = static_cast<std::size_t>(program().signals[signal].block);
  const auto& series = *b.run.series[static_cast<std::size_t>(program().blocks[block].series_index)];
  Rows rows;
  rows.reserve(b.times.size());
  for (const double t : b.times) rows.push_back(series.value(t, t));
  return rows;
}

int DataModel::main_input() const {
  int best = -1;
  double largest = -1;
  for (int i = 0; i < static_cast<int>(program().input_names.size()); ++i) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int r = 0; r < n_recordings(); ++r)
      for (const double u : input(r, i)) {
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
  return best;
}

double DataModel::span(int output) const { return content_->spans[static_cast<std::size_t>(output)]; }
const std::string& DataModel::why_not_exact() const { return content_->not_exact; }

Prediction DataModel::predict(std::span<const ParameterValue> values, std::span<const int> recordings,
                              bool with_initial) {
  Content& c = *content_;
  if (!c.substeps_chosen) choose_substeps(values);
  Prediction prediction;
  prediction.y.resize(c.bound.size());
  prediction.initial.resize(c.bound.size());
  std::vector<std::string> errors(c.bound.size());
  c.side_by_side(recordings, [&](int r) {
    c.predict_one(r, values, with_initial, prediction, errors[static_cast<std::size_t>(r)]);
  });
  for (const auto& error : errors)
    if (!error.empty() && prediction.ok) {
      prediction.ok = false;
      prediction.error = error;
    }
  return prediction;
}

std::vector<std::string> DataModel::choose_substeps(std::span<const ParameterValue> values,
                                                    std::span<const double> noise, bool only_finer) {
  Content& c = *content_;
  std::vector<std::string> remarks;
  if (!c.not_exact.empty() || !c.needs_substeps) {
    c.substeps_chosen = true;
    return remarks;
  }
  std::vector<double> tolerance(c.outputs.size());
  for (std::size_t o = 0; o < tolerance.size(); ++o)
    tolerance[o] = std::max(c.options.substep_tolerance * c.spans[o], noise.empty() ? 0.0 : noise[o] / 1000);
  bool all = true;
  for (int r = 0; r < n_recordings(); ++r) {
    Bound& b = c.bound[static_cast<std::size_t>(r)];
    try {
      auto coarse = c.one(r, values, 1, false);
      int n = 1;
      for (; n < c.options.max_substeps; n *= 2) {
        auto fine = c.one(r, values, 2 * n, false);
        double worst = 0;
        for (std::size_t o = 0; o < fine.size(); ++o)
          for (std::size_t i = 0; i < fine[o].size(); ++i)
            worst = std::max(worst, std::abs(fine[o][i] - coarse[o][i]) / std::max(tolerance[o], 1e-300));
        // The error falls at least in proportion to the step, so what changed by halving it is more than what is left.
        if (worst <= 1) break;
        coarse = std::move(fine);
      }
      b.substeps = only_finer ? std::max(n, b.substeps) : n;
      if (n >= c.options.max_substeps)
        remarks.push_back(
            fmt::format("{}: {} substeps per row do not suffice for the tolerance asked for", recording(r).name, n));
    } catch (const std::exception&) {
      all = false;  // at values where it can be simulated this is done again
    }
  }
  c.substeps_chosen = all;
  return remarks;
}

int DataModel::substeps(int recording) const { return content_->bound[static_cast<std::size_t>(recording)].substeps; }

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
const std::vector<std::string>& DataModel::remarks() const { return content_->remarks; }
long DataModel::runs() const { return content_->runs; }
long DataModel::failures() const { return content_->failures; }

int parameter_index(const Program& program, const std::string& path) {
  if (const auto* info = program.find_parameter(path)) return static_cast<int>(info - program.parameters.data());
  std::vector<std::string> names;
  for (const auto& p : program.parameters) names.push_back(p.path);
  fail("unknown_parameter", path, fmt::format("there is no parameter \"{}\"", path), did_you_mean(path, names));
}

}  // namespace hysteron
