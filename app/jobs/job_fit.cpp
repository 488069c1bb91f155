// The runs of a job that fit: a diagram's free parameters to the rows of another run, or a fit job.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/cli/load.h"
#include "app/jobs/job_runs.h"
#include "app/jobs/job_values.h"
#include "engine/diagram/error.h"
#include "fit/estimate/fit.h"
#include "fit/model/model.h"
#include "fit/signals/features.h"
#include "fit/thesis/problem.h"
#include "fit/thesis/thesis_methods.h"
#include "io/diagram/diagram_file.h"

namespace hysteron {
namespace {

/// What a fit could not reach: rms of the residual of the first output, and the sum of its squares.
void add_errors(RunResult& r, const FitResult& found, const DataModel& model) {
  double sum = 0, rows = 0;
  for (const auto& one : found.after.recordings) {
    if (one.role != Role::train || model.measured(one.recording, 0).empty()) continue;
    const auto n = static_cast<double>(model.measured(one.recording, 0).size());
    sum += n * one.rms[0] * one.rms[0];
    rows += n;
  }
  const Unit unit = without_offset(model.output_unit(0));
  r.numbers.emplace_back("rms", Quantity{rows > 0 ? std::sqrt(sum / rows) : 0, unit, true});
  r.numbers.emplace_back("cost", Quantity{sum, squared(unit), true});
}

/// The method of the job that has this name, else one without settings.
void choose_method(FitJob& job, const WrittenText& name) {
  const auto found =
      std::find_if(job.methods.begin(), job.methods.end(), [&](const auto& m) { return m.name.text == name.text; });
  MethodWish method;
  if (found != job.methods.end()) method = *found;
  method.name = name;
  job.methods = {method};
}

}  // namespace

/// The rows of another run as one recording, from rest.
DataSet JobRunner::data_of(const FitDataWish& wish) {
  const RunResult& from = result(wish.run);
  Recording recording;
  recording.name = wish.run.text;
  recording.t = from.columns.front().values;
  const auto [first, last] = window_rows(recording.t, wish.between);
  recording.first = first;
  recording.last = last;
  DataSet data;
  for (const auto& [column, signal] : wish.columns) {
    const RunColumn& c = at(signal.pointer, [&]() -> const RunColumn& { return column_of(from, signal); });
    auto values = c.values;
    if (std::find(wish.rezero.begin(), wish.rezero.end(), column) != wish.rezero.end())
      for (auto& v : values) v -= c.values[first];
    recording.columns[column] = std::move(values);
    recording.units[column] = c.unit;
    data.notes[column].to = column;
    // Every row counts alike: a plain sum of squares, as the thesis has it (Eq. 2.42).
    data.notes[column].noise = {1e-3 * features::stroke(c.values), {}, 0.0};
  }
  data.recordings.push_back(std::move(recording));
  return data;
}

RunResult JobRunner::fitted(const RunWish& run) {
  FitJob job;
  if (is_job(run.file)) {
    job = read_fit_job(run.file, pool_->allowed());
  } else {
    job.diagram = run.file;
    job.methods.emplace_back();
  }
  if (run.method) choose_method(job, *run.method);
  if (job.thresholds)
    fail("not_yet", run.pointer, "a run does not place thresholds",
         "write them into the diagram, as \"hysteron fit\" found them");
  if (!run.data && job.data.empty())
    fail("missing_key", run.pointer, "there is nothing to fit",
         "write \"data\": {\"run\": \"loop\", \"columns\": {...}}, or name a fit job");
  Diagram diagram = read_diagram(job.diagram, pool_->allowed());
  apply_settings(diagram, job.set, job.choose);
  apply_settings(diagram, run.set, run.choose);
  const ProgramPointer program = compile_file(diagram);
  const auto data =
      std::make_shared<const DataSet>(run.data ? data_of(*run.data) : read_dataset(job.data, pool_->allowed()));
  check_binding(*data, *program);
  FitProblem problem = problem_of(job, *program, *data, run.free);
  DataModel model(program, data, {});
  const NoiseModel noise = noise_before_fit(model);
  FitMethod& method = problem.methods.front();
  method.options.intervals = false;
  const FitResult found =
      method.of_thesis ? fit_as_thesis(model, noise, method.name) : fit(model, noise, problem.free, method.options);
  if (!found.ok)
    fail_numerics("fit_failed", run.pointer, found.error, "start from other values, or give narrower bounds");
  RunResult r;
  for (const auto& e : found.estimates) r.numbers.emplace_back(e.path, Quantity{e.used, e.unit, e.difference});
  add_errors(r, found, model);
  return r;
}

}  // namespace hysteron
