// The runs of a job that are studies: the samples of a "study" job as rows, what it counted as numbers.
#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "app/cli/load.h"
#include "app/jobs/job_runs.h"
#include "engine/diagram/error.h"
#include "fit/study/study_problem.h"
#include "io/diagram/diagram_file.h"
#include "io/jobs/study_job.h"

namespace hysteron {
namespace {

/// "passed.settled": by the column of the filter; the second one on the same column is "passed.settled_2".
void add_counts(RunResult& r, const Study& study, const StudyCounts& counts) {
  const Unit number = parse_unit("");
  const auto draws = static_cast<double>(counts.draws);
  r.numbers.emplace_back("draws", Quantity{draws, number, true});
  r.numbers.emplace_back("accepted", Quantity{static_cast<double>(counts.accepted) / draws, number, true});
  for (std::size_t i = 0; i < study.filters.size(); ++i) {
    const std::string name = "passed." + study.columns[static_cast<std::size_t>(study.filters[i].column)].name;
    std::string told = name;
    for (int n = 2; r.number(told) != nullptr; ++n) told = fmt::format("{}_{}", name, n);
    r.numbers.emplace_back(told, Quantity{static_cast<double>(counts.passed[i]) / draws, number, true});
  }
}

Study study_in(const StudyJob& job, const std::vector<std::string>& allowed) {
  try {
    Diagram diagram = read_diagram(job.diagram, allowed);
    apply_settings(diagram, job.set, job.choose);
    Study study = study_of(job, compile_file(diagram)).study;
    study.histograms.clear();  // of the study's own page
    return study;
  } catch (Error& error) {
    locate_problems(error, job.file);
    throw Error(error.fault, error.problems);
  }
}

/// Places of the columns that are recorded; all, if none is named.
std::vector<std::size_t> recorded(const Study& study, const std::vector<WrittenText>& names) {
  std::vector<std::string> known;
  for (const auto& column : study.columns) known.push_back(column.name);
  std::vector<std::size_t> places;
  for (const auto& name : names) {
    const auto found = std::find(known.begin(), known.end(), name.text);
    if (found == known.end())
      fail("unknown_feature", name.pointer,
           fmt::format("the study has no feature and no varied parameter \"{}\"", name.text),
           did_you_mean(name.text, known));
    places.push_back(static_cast<std::size_t>(found - known.begin()));
  }
  for (std::size_t c = 0; names.empty() && c < known.size(); ++c) places.push_back(c);
  return places;
}

}  // namespace

RunResult JobRunner::studied(const RunWish& run) {
  StudyJob job = read_study_job(run.file, pool_->allowed());
  if (run.size->draws) {
    job.draws = run.size->draws;
    job.accepted.reset();
    job.give_up_after.reset();
  } else if (run.size->accepted) {
    job.accepted = run.size->accepted;
    job.draws.reset();
  }
  if (run.every) job.every = run.every;
  if (run.step) job.step = run.step;
  const Study study = study_in(job, pool_->allowed());
  const std::vector<std::size_t> columns = recorded(study, run.record);
  StudyTable table = compute_study(study, std::max(1, static_cast<int>(std::thread::hardware_concurrency())), columns);
  if (table.draw.empty())
    fail_numerics("nothing_accepted", run.pointer,
                  fmt::format("none of {} draws passed all filters", table.counts.draws),
                  "draw more, or widen the filters");
  RunResult r;
  const Unit number = parse_unit("");
  r.columns.push_back({"draw", "draw", number, {table.draw.begin(), table.draw.end()}});
  r.columns.push_back({"accepted", "accepted", number, {table.accepted.begin(), table.accepted.end()}});
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const StudyColumn& column = study.columns[columns[c]];
    std::vector<double>& values = table.columns[c];
    for (double& v : values) v = column.difference ? column.unit.difference_to_si(v) : column.unit.to_si(v);
    r.columns.push_back({column.name, column.name, column.unit, std::move(values)});
  }
  add_counts(r, study, table.counts);
  return r;
}

}  // namespace hysteron
