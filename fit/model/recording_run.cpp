// One recording, simulated: bound to the program once, then run with any parameter values at exactly its instants.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/events/rest.h"
#include "engine/program/names.h"
#include "engine/program/nominal.h"
#include "engine/rowwise/schedule.h"
#include "engine/simulate/simulate.h"
#include "fit/model/model_content.h"

namespace hysteron {
namespace {

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
  BoundRecording& b = bound[static_cast<std::size_t>(r)];
  b.run = start(*program);
  for (const auto& input : program->input_names)
    bind_input(*program, b.run, input, input_series(*data, recording, input));

  b.times = judged(r, recording.t);
  b.measured.assign(outputs.size(), std::make_shared<const Rows>());
  b.at.resize(outputs.size());
  for (std::size_t o = 0; o < outputs.size(); ++o)
    if (const auto column = recording.columns.find(outputs[o]); column != recording.columns.end())
      b.measured[o] = judged(r, column->second);
  if (judges_rows_as_they_are(recording))
    bind_rows(r);
  else
    bind_late_rows(r);
  b.points_per_instant =
      static_cast<double>(rows_between(b.instants(), b.run.series).size()) / static_cast<double>(b.instants().size());
  if (not_exact.empty()) {
    b.cut({});
    b.advance.emplace(program, signals);
    needs_substeps = needs_substeps || !b.advance->exact_without_substeps();
  }
}

/// Those that are judged; where all are, those of the data set.
RowsPointer DataModel::Content::judged(int r, const std::vector<double>& column) const {
  const Recording& recording = data->recordings[static_cast<std::size_t>(r)];
  if (recording.first == 0 && recording.last == column.size() && recording.left_out.empty()) return {data, &column};
  return std::make_shared<const Rows>(recording.judged(column));
}

/// Every row of some output, and no output late.
bool DataModel::Content::judges_rows_as_they_are(const Recording& recording) const {
  if (recording.first != 0 || recording.last != recording.t.size() || !recording.left_out.empty()) return false;
  const auto is_measured = [&](const std::string& output) { return recording.columns.contains(output); };
  const auto is_in_time = [&](const std::string& output) {
    const auto note = data->notes.find(output);
    return note == data->notes.end() || (note->second.delay_samples == 0 && note->second.delay_seconds == 0);
  };
  return std::any_of(outputs.begin(), outputs.end(), is_measured) &&
         std::all_of(outputs.begin(), outputs.end(), is_in_time);
}

void DataModel::Content::bind_rows(int r) {
  const Recording& recording = data->recordings[static_cast<std::size_t>(r)];
  BoundRecording& b = bound[static_cast<std::size_t>(r)];
  b.evaluated = {data, &recording.t};
  for (std::size_t o = 0; o < outputs.size(); ++o)
    if (recording.columns.contains(outputs[o])) b.at[o] = RowPlaces(recording.t.size());
}

void DataModel::Content::bind_late_rows(int r) {
  const Recording& recording = data->recordings[static_cast<std::size_t>(r)];
  BoundRecording& b = bound[static_cast<std::size_t>(r)];
  std::vector<std::vector<double>> wanted(outputs.size());
  const double begin = recording.t.front();
  std::vector<double> instants{begin};
  for (std::size_t o = 0; o < outputs.size(); ++o) {
    if (!recording.columns.contains(outputs[o])) continue;
    // Before the start the model is where it starts: at rest there.
    for (const double t : recording.judged(output_instants(*data, recording, outputs[o])))
      wanted[o].push_back(std::max(begin, t));
    instants.insert(instants.end(), wanted[o].begin(), wanted[o].end());
  }
  std::sort(instants.begin(), instants.end());
  instants.erase(std::unique(instants.begin(), instants.end()), instants.end());
  for (std::size_t o = 0; o < outputs.size(); ++o) {
    std::vector<std::size_t> places;
    places.reserve(wanted[o].size());
    for (const double t : wanted[o])
      places.push_back(
          static_cast<std::size_t>(std::lower_bound(instants.begin(), instants.end(), t) - instants.begin()));
    b.at[o] = RowPlaces(std::move(places));
  }
  b.evaluated = std::make_shared<const std::vector<double>>(std::move(instants));
}

/// What runs have worked with; the next one makes it anew.
void DataModel::Content::release(BoundRecording& b) const {
  b.values = {};
  b.many_values = {};
  if (b.advance) b.advance.emplace(program, signals);
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
      free_states.push_back(program->state_names[index]);
      free_state_index.push_back(index);
      free_state_is_linear.push_back(linear[b]);
    }
    if (block.sizes.memory > 0)
      remarks.push_back(fmt::format("the memory of {} begins virgin in every recording", block.path));
  }
}

/// A run with these values; throws where a block refuses them.
Run DataModel::Content::prepared(int r, std::span<const ParameterValue> values) const {
  Run run = bound[static_cast<std::size_t>(r)].run;
  for (const auto& v : values) {
    if (v.recording >= 0 && v.recording != r) continue;
    if (!std::isfinite(v.value))
      fail_numerics("not_finite", program->parameters[static_cast<std::size_t>(v.parameter)].path,
                    "value is not finite", "give a finite start value");
    for (const int slot : program->parameters[static_cast<std::size_t>(v.parameter)].slots) {
      run.p[static_cast<std::size_t>(slot)] = v.value;
      run.varied.push_back(slot);
    }
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
  for (const auto& [name, value] : recording.initial_values)
    run.x[static_cast<std::size_t>(named_state(*program, name))] = value;
  begin_modes(*program, run);
}

/// values[output][instant] of one recording.
void DataModel::Content::simulate_into(BoundRecording& b, Run run, bool at_rest, int substeps, bool cvode) const {
  if (b.advance && not_exact.empty() && !cvode) {
    AdvanceOptions o;
    o.substeps = substeps;
    o.at_rest = at_rest;
    (*b.advance)(run, b.rows, o, b.values);
    b.keep_instants(b.values);
    return;
  }
  SimulateOptions o;
  o.begin = b.instants().front();
  o.until = b.instants().back();
  o.instants = b.instants();
  o.signals = signals;
  o.method = Method::bdf;
  o.relative_tolerance = options.relative_tolerance;
  o.at_rest = at_rest;
  b.values = simulate(*program, std::move(run), o).values;
}

std::vector<Rows> DataModel::Content::rows_of(const BoundRecording& b,
                                              const std::vector<std::vector<double>>& values) const {
  std::vector<Rows> rows(outputs.size());
  for (std::size_t o = 0; o < outputs.size(); ++o) {
    const auto& at = b.at[o];
    if (at.empty()) continue;
    if (at[at.size() - 1] - at[0] + 1 == at.size()) {
      const auto first = values[o].begin() + static_cast<std::ptrdiff_t>(at[0]);
      rows[o].assign(first, first + static_cast<std::ptrdiff_t>(at.size()));
    } else {
      rows[o].reserve(at.size());
      for (std::size_t i = 0; i < at.size(); ++i) rows[o].push_back(values[o][at[i]]);
    }
    const auto bad = std::find_if(rows[o].begin(), rows[o].end(), [](double y) { return !std::isfinite(y); });
    if (bad != rows[o].end())
      fail_numerics(
          "diverged", outputs[o],
          fmt::format("not finite at {} s", b.instants()[at[static_cast<std::size_t>(bad - rows[o].begin())]]),
          "narrow the bounds");
  }
  return rows;
}

std::vector<Rows> DataModel::Content::one(int r, std::span<const ParameterValue> values, int substeps, bool cvode) {
  BoundRecording& b = bound[static_cast<std::size_t>(r)];
  ++runs;
  simulate_into(b, begun_at_start(r, values), settles(r), substeps, cvode);
  return rows_of(b, b.values);
}

/// It settles where its inputs hold it; where a start of its own is found the run comes with it.
bool DataModel::Content::settles(int r) const {
  return bound[static_cast<std::size_t>(r)].start.empty() && data->recordings[static_cast<std::size_t>(r)].at_rest;
}

/// From the equilibrium to the start that was found.
void DataModel::Content::move_start(const BoundRecording& b, Run& run) const {
  for (std::size_t k = 0; k < b.start.size(); ++k) run.x[free_state_index[k]] += b.start[k];
  begin_modes(*program, run);
}

Run DataModel::Content::begun_at_start(int r, std::span<const ParameterValue> values) {
  const BoundRecording& b = bound[static_cast<std::size_t>(r)];
  const Recording& recording = data->recordings[static_cast<std::size_t>(r)];
  if (from_rest(recording) && !settles(r)) {
    Run run = in_equilibrium(r, values);
    move_start(b, run);
    return run;
  }
  Run run = prepared(r, values);
  set_start(recording, run, b.instants().front());
  return run;
}

Run DataModel::Content::in_equilibrium(int r, std::span<const ParameterValue> values) {
  BoundRecording& b = bound[static_cast<std::size_t>(r)];
  if (b.rest && std::equal(values.begin(), values.end(), b.rest_of.begin(), b.rest_of.end())) return *b.rest;
  Run rest = prepared(r, values);
  rest.t = b.instants().front();
  try {
    Run settled = rest;
    settle_at_rest(*program, settled, settled.t);
    rest = std::move(settled);
  } catch (const Error& e) {  // an integrator whose input is not zero: its start is found from what is declared
    if (data->recordings[static_cast<std::size_t>(r)].at_rest || e.problems.front().code != "no_rest") throw;
  }
  b.rest_of.assign(values.begin(), values.end());
  b.rest = rest;
  return rest;
}

/// Of a state behind which all is linear any step will do; of another one so small that the answer is as good as
/// linear, and so large that it is not lost in rounding or in the integrator's tolerance.
constexpr double step_of_a_start = 1e-3;  // of the state's nominal size

void DataModel::Content::predict_initial(int r, std::span<const ParameterValue> values, Prediction& prediction) {
  BoundRecording& b = bound[static_cast<std::size_t>(r)];
  const auto k = static_cast<std::size_t>(r);
  Run begun = in_equilibrium(r, values);
  move_start(b, begun);
  const auto sizes = nominal_states(*program, begun);
  std::vector<double> steps;
  std::vector<Run> runs_begun{begun};
  for (std::size_t n = 0; n < free_state_index.size(); ++n) {
    const std::size_t state = free_state_index[n];
    steps.push_back(free_state_is_linear[n] ? 1.0 : step_of_a_start * sizes[state]);
    Run& moved = runs_begun.emplace_back(begun);
    moved.x[state] += steps.back();
    begin_modes(*program, moved);
  }
  auto rows = rows_of_each(b, std::move(runs_begun));
  for (std::size_t n = 0; n < steps.size(); ++n) {
    auto& moved = rows[n + 1];
    for (std::size_t o = 0; o < moved.size(); ++o)
      for (std::size_t i = 0; i < moved[o].size(); ++i) moved[o][i] = (moved[o][i] - rows[0][o][i]) / steps[n];
    prediction.initial[k].push_back(std::move(moved));
  }
}

/// Side by side where the advance is exact; throws where one of them fails.
std::vector<std::vector<Rows>> DataModel::Content::rows_of_each(BoundRecording& b, std::vector<Run> begun) {
  std::vector<std::vector<Rows>> rows;
  runs += static_cast<long>(begun.size());
  if (b.advance && not_exact.empty() && !options.force_cvode) {
    std::vector<const Run*> list;
    for (const auto& run : begun) list.push_back(&run);
    const AdvanceOptions how{.substeps = b.substeps, .at_rest = false};
    const auto why = b.advance->each(list, b.rows, how, b.many_values);
    if (std::all_of(why.begin(), why.end(), [](const std::string& text) { return text.empty(); })) {
      for (std::size_t i = 0; i < begun.size(); ++i) {
        b.keep_instants(b.many_values[i]);
        rows.push_back(rows_of(b, b.many_values[i]));
      }
      return rows;
    }
  }
  for (auto& run : begun) {
    simulate_into(b, std::move(run), false, b.substeps, options.force_cvode);
    rows.push_back(rows_of(b, b.values));
  }
  return rows;
}

/// As `one`, with finer and finer substeps where nonlinear states run away: values far from those for which the
/// substeps were chosen may be stiffer. A trial that only needs more of them is not lost.
std::vector<Rows> DataModel::Content::finer_until_finite(int r, std::span<const ParameterValue> values) {
  const BoundRecording& b = bound[static_cast<std::size_t>(r)];
  const bool integrates = b.advance && not_exact.empty() && !options.force_cvode && b.advance->integrates();
  for (int substeps = b.substeps;; substeps *= 4) {
    try {
      return one(r, values, substeps, options.force_cvode);
    } catch (const Error& e) {
      if (!integrates || 4 * substeps > options.max_substeps || e.problems.front().code != "diverged") throw;
    }
  }
}

/// No exception leaves: a failing simulation is a text.
void DataModel::Content::predict_one(int r, std::span<const ParameterValue> values, bool with_initial,
                                     Prediction& prediction, std::string& error) {
  const auto k = static_cast<std::size_t>(r);
  try {
    prediction.y[k] = finer_until_finite(r, values);
    if (with_initial && data->recordings[k].initial_per_recording && !free_states.empty())
      predict_initial(r, values, prediction);
  } catch (const std::exception& e) {
    ++failures;
    error = fmt::format("{}: {}", data->recordings[k].name, e.what());
  }
}

/// Trials side by side where the advance is exact; per trial "" or why it failed.
std::vector<std::string> DataModel::Content::predict_trials(int r, std::span<const Trial> trials,
                                                            std::vector<Prediction>& predictions) {
  const auto k = static_cast<std::size_t>(r);
  BoundRecording& b = bound[k];
  std::vector<std::string> errors(trials.size());
  if (!b.advance || !not_exact.empty()) {
    for (std::size_t i = 0; i < trials.size(); ++i) predict_one(r, trials[i], false, predictions[i], errors[i]);
    return errors;
  }
  const Recording& recording = data->recordings[k];
  const auto say = [&](std::size_t i, const std::string& why) {
    ++failures;
    errors[i] = fmt::format("{}: {}", recording.name, why);
  };
  std::vector<Run> started;
  std::vector<std::size_t> trial_of;
  started.reserve(trials.size());
  for (std::size_t i = 0; i < trials.size(); ++i) {
    ++runs;
    try {
      started.push_back(begun_at_start(r, trials[i]));
      trial_of.push_back(i);
    } catch (const std::exception& e) {
      say(i, e.what());
    }
  }
  std::vector<const Run*> list;
  for (const auto& run : started) list.push_back(&run);
  const AdvanceOptions how{.substeps = b.substeps, .at_rest = settles(r)};
  const auto why = b.advance->each(list, b.rows, how, b.many_values);
  for (std::size_t i = 0; i < why.size(); ++i) {
    if (!why[i].empty()) {
      predict_one(r, trials[trial_of[i]], false, predictions[trial_of[i]], errors[trial_of[i]]);
      continue;
    }
    b.keep_instants(b.many_values[i]);
    try {
      predictions[trial_of[i]].y[k] = rows_of(b, b.many_values[i]);
    } catch (const std::exception& e) {
      say(trial_of[i], e.what());
    }
  }
  return errors;
}

}  // namespace hysteron
