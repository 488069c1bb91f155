// Decides how the runs of a job ("do": "runs") come to their results, each done once, when it is asked for:
// simulations, tables and runs of other jobs (job_runs.cpp), fits (job_fit.cpp), linearizations (job_linear.cpp),
// searches (job_minimize.cpp), studies (job_study.cpp), rows that are made of other rows (job_formulas.cpp). Does not
// draw (job_figures.h) and does not judge (claims.h).
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "engine/diagram/error.h"
#include "engine/diagram/units.h"
#include "engine/program/program.h"
#include "engine/simulate/simulate.h"
#include "io/data/dataset.h"
#include "io/jobs/runs_job.h"

namespace hysteron {

/// A number with its unit, in SI; a difference does not know the unit's offset.
struct Quantity {
  double si = 0;
  Unit unit{};
  bool difference = false;
};

/// A signal over the rows of a run, in SI.
struct RunColumn {
  std::string name;  ///< as it was asked for
  std::string path;  ///< as the program calls it
  Unit unit{};
  std::vector<double> values;
};

struct RunResult {
  std::vector<RunColumn> columns;                         ///< the first one: time, or frequency
  std::vector<std::pair<std::string, Quantity>> numbers;  ///< fitted parameters, margins ...
  const RunColumn* find(const std::string& signal) const;
  const Quantity* number(const std::string& name) const;
};

class JobRunner;

/// The jobs that were asked for so far; several threads may ask. A job is read once.
class JobPool {
 public:
  /// `full`: jobs take the sizes under "full".
  explicit JobPool(std::vector<std::string> allowed = {}, bool full = false);
  ~JobPool();
  /// Throws Error as reading does, and "circular" where jobs take runs of each other.
  JobRunner& job(const std::string& file);
  const std::vector<std::string>& allowed() const { return allowed_; }

 private:
  void open(const RunWish& run, const std::string& from);

  std::vector<std::string> allowed_;
  bool full_;
  std::recursive_mutex mutex_;
  std::map<std::string, std::unique_ptr<JobRunner>> jobs_;
  std::vector<std::string> opening_;
};

/// One job and what its runs have given so far; several threads may ask at once.
class JobRunner {
 public:
  JobRunner(JobPool& pool, RunsJob job);
  const RunsJob& job() const { return job_; }

  /// Throws Error whose problems tell file and line of the job or of the diagram.
  const RunResult& result(const WrittenText& run) { return *shared_result(run); }
  std::shared_ptr<const RunResult> shared_result(const WrittenText& run);
  const Quantity& value(const WrittenText& name);
  /// What `wish` takes from `result`; used for values of the job, and while something is sought.
  Quantity take(const ValueWish& wish, const RunResult& result);

  /// A signal of a run, less what the wish says, inside the window, both ends included; with `rezero` less its first
  /// row. SI.
  struct Rows {
    std::vector<double> t, y;
    Unit unit{};
    bool difference = false;
  };
  Rows rows(const SignalWish& wish, const RunResult& result, const Window& window, bool rezero,
            const std::vector<RowCondition>& where = {});
  /// A number of the job in SI; a plain one is in the unit expected. Throws Error "wrong_unit" at its place.
  static double si(const WrittenNumber& number, const Unit& expected);
  static double seconds(const WrittenNumber& number);

  /// The same job if one of its runs had given `result`; the others have given what they gave here. A claim that cannot
  /// fail is found by it. Throws Error as result().
  std::unique_ptr<JobRunner> with_result(const std::string& run, RunResult result);

  /// Runs `action`; problems of an Error that stand nowhere yet get `pointer` of this job and its line.
  template <class Action>
  auto at(const std::string& pointer, const Action& action) -> decltype(action());

 private:
  const RunWish& wish(const WrittenText& run) const;
  std::shared_ptr<const RunResult> done(const RunWish& run);
  /// The diagram of a run with its settings, and what it is compiled to.
  std::pair<Diagram, ProgramPointer> program_of(const RunWish& run) const;
  Run started(const RunWish& run, const Program& program);
  std::vector<std::pair<std::string, int>> signals_of(const RunWish& run, const Diagram& diagram,
                                                      const Program& program);
  DataSet data_of(const FitDataWish& wish);
  RunResult simulated(const RunWish& run);
  RunResult linearized(const RunWish& run);
  RunResult fitted(const RunWish& run);
  RunResult sought(const RunWish& run);
  RunResult minimized(const RunWish& run);
  RunResult studied(const RunWish& run);
  /// A simulation of a run that stands at its start.
  RunResult traced(const Program& program, Run start_of, SimulateOptions options,
                   const std::vector<std::pair<std::string, int>>& asked) const;
  /// The run before it is prepared, with what other runs and values of the job give.
  Run with_settings(const RunWish& run, const Program& program);
  SimulateOptions options_of(const RunWish& run, const Program& program) const;
  RunResult table(const RunWish& run) const;
  RunResult selected(const RunWish& run);
  RunResult made_of_values(const RunWish& run);
  RunResult of_formula(const RunWish& run);
  /// Which rows of a run fulfil all conditions.
  std::vector<char> kept(const std::vector<RowCondition>& where, const RunResult& result);
  /// Signals that the job asks of a run, with where it does so.
  std::vector<WrittenText> wanted(const RunWish& run) const;
  [[noreturn]] void blame(Error& error, const std::string& pointer) const;

  JobPool* pool_;
  RunsJob job_;
  /// Runs need no circle of each other (io/jobs/runs_job.h), so threads that wait for one never wait for each other.
  struct Slot {
    std::mutex mutex;
    std::shared_ptr<const RunResult> result{};
  };
  std::map<std::string, Slot> slots_;  ///< one per run, from the start
  std::mutex values_mutex_;
  std::map<std::string, Quantity> values_;
};

template <class Action>
auto JobRunner::at(const std::string& pointer, const Action& action) -> decltype(action()) {
  try {
    return action();
  } catch (Error& error) {
    blame(error, pointer);
  }
}

}  // namespace hysteron
