// The runs of a job that are studies: the samples of a "study" job as rows, what it counted as numbers.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "app/job_runs.h"
#include "app/load.h"
#include "engine/error.h"
#include "fit/study_problem.h"
#include "io/diagram_file.h"
#include "io/study_job.h"

namespace hysteron {
namespace {

/// What is kept of one shard: draw and acceptance of each sample, and the columns that are wanted.
struct Kept {
  std::vector<double> draw, accepted;
  std::vector<std::vector<double>> columns;
  StudyCounts counts;
};

Kept kept_of_shard(const Study& study, int shard, const std::vector<std::size_t>& wanted) {
  Kept kept;
  kept.columns.resize(wanted.size());
  kept.counts = *compute_shard(study, shard, study.shards, [&](const StudySample& sample) {
    kept.draw.push_back(static_cast<double>(sample.draw));
    kept.accepted.push_back(sample.accepted ? 1 : 0);
    for (std::size_t c = 0; c < wanted.size(); ++c) {
      const StudyColumn& column = study.columns[wanted[c]];
      const double shown = sample.row[wanted[c]];
      kept.columns[c].push_back(column.difference ? column.unit.difference_to_si(shown) : column.unit.to_si(shown));
    }
  });
  return kept;
}

/// All shards, on all processors; what comes out does not depend on how many there are.
std::vector<Kept> all_shards(const Study& study, const std::vector<std::size_t>& wanted) {
  std::vector<Kept> parts(static_cast<std::size_t>(study.shards));
  std::atomic<int> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    for (int k = next++; k < study.shards; k = next++) try {
        parts[static_cast<std::size_t>(k)] = kept_of_shard(study, k, wanted);
      } catch (...) {
        const std::lock_guard lock(mutex);
        failure = std::current_exception();
      }
  };
  std::vector<std::thread> others;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) others.emplace_back(work);
  work();
  for (auto& thread : others) thread.join();
  if (failure) std::rethrow_exception(failure);
  return parts;
}

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
  std::vector<Kept> parts = all_shards(study, columns);
  RunResult r;
  r.columns.push_back({"draw", "draw", parse_unit(""), {}});
  r.columns.push_back({"accepted", "accepted", parse_unit(""), {}});
  for (const std::size_t c : columns)
    r.columns.push_back({study.columns[c].name, study.columns[c].name, study.columns[c].unit, {}});
  StudyCounts counts = StudyCounts::of(study);
  for (Kept& part : parts) {
    const auto append = [](std::vector<double>& to, std::vector<double>& from) {
      to.insert(to.end(), from.begin(), from.end());
      std::vector<double>().swap(from);
    };
    append(r.columns[0].values, part.draw);
    append(r.columns[1].values, part.accepted);
    for (std::size_t c = 0; c < columns.size(); ++c) append(r.columns[c + 2].values, part.columns[c]);
    counts.add(part.counts);
  }
  if (counts.draws == 0 || r.columns[0].values.empty())
    fail_numerics("nothing_accepted", run.pointer, fmt::format("none of {} draws passed all filters", counts.draws),
                  "draw more, or widen the filters");
  add_counts(r, study, counts);
  return r;
}

}  // namespace hysteron
