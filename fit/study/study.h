// Decides what a study is: draws of parameters, numbers taken from each simulation, filters, and what is counted; and
// how one shard of it is computed. Plain values; does not read jobs (study_problem.h) and does not write files (io).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/program/program.h"
#include "engine/simulate/simulate.h"
#include "fit/study/reducers.h"
#include "fit/study/sampler.h"

namespace hysteron {

/// A parameter or a feature. Everything a study keeps and compares is in the unit of its column.
struct StudyColumn {
  std::string name, meaning;
  std::string remark{};  ///< for people; decides nothing
  std::string told() const { return remark.empty() ? meaning : meaning + ": " + remark; }
  Unit unit{};
  bool difference = false;  ///< converted without the unit's offset
  double shown(double si) const { return difference ? unit.difference_from_si(si) : unit.from_si(si); }
};

/// A number that is made of others.
struct Combination {
  std::string how{};  ///< one of combinations() (io/jobs/runs_job.h)
  struct Operand {
    int column = -1;      ///< an earlier one ...
    double constant = 0;  ///< ... or this [SI]
  };
  std::vector<Operand> of{};
};

/// Column parameters + i is either of a trace or of other columns.
struct StudyFeature {
  int trace = -1;  ///< place in Study::traces
  Combination combination{};
};

/// Bounds in the unit of the column. Nothing that is not finite holds.
struct Condition {
  int column = 0;
  std::optional<double> above{}, at_least{}, below{}, at_most{};
  bool holds(std::span<const double> row) const;
};
bool all_hold(const std::vector<Condition>& conditions, std::span<const double> row);

/// Counts per bin of equal width (in the logarithm) from `from` to `to`, both ends included; values outside do not
/// count.
struct Bins {
  double from = 0, to = 1;
  int count = 30;
  bool log = false;
  std::optional<int> bin(double value) const;
  double edge(int i) const;  ///< 0 ... count
};

/// A histogram of all draws, counted while they are made.
struct DrawHistogram {
  int column = 0;
  Bins bins{};
  std::vector<Condition> where{};
};

struct Study {
  ProgramPointer program;
  Run base{};                      ///< at its start
  SimulateOptions options{};       ///< its signals are those that `traces` speak of
  std::vector<double> instants{};  ///< of the rows [s]
  std::vector<int> parameters{};   ///< varied: places in program->parameters
  std::optional<Sampler> sampler{};
  std::vector<TraceFeature> traces{};
  std::vector<StudyFeature> features{};
  std::vector<StudyColumn> columns{};  ///< parameters, then features
  std::vector<Condition> filters{};
  std::vector<DrawHistogram> histograms{};
  std::uint64_t seed = 1;
  std::uint64_t draws = 0;          ///< so many in all; 0: until `accepted` are found
  std::uint64_t accepted = 0;       ///< wanted, where draws = 0
  std::uint64_t give_up_after = 0;  ///< draws in all, where draws = 0
  bool simulate_refused = false;    ///< values that a block refuses: simulated all the same, else failed draws
  bool keep_all = false;            ///< rejected draws are kept, too
  int shards = 1;
  std::string description{};  ///< all of it as text, but for the number of shards: what decides the numbers
};

/// What a study counts beside the samples that it keeps; shards add up.
struct StudyCounts {
  std::uint64_t draws = 0, accepted = 0;
  std::vector<std::uint64_t> passed{};            ///< per filter, alone
  std::vector<std::uint64_t> not_finite{};        ///< per column: draws of which this is the first that is not finite
  std::map<std::string, std::uint64_t> failed{};  ///< simulations by the code of what went wrong
  std::string failure{};                          ///< what the first of them said
  std::uint64_t failure_draw = 0;
  std::vector<std::vector<std::uint64_t>> histograms{};  ///< as Study::histograms
  bool gave_up = false;                                  ///< fewer were accepted than wanted

  static StudyCounts of(const Study& study);
  void add(const StudyCounts& other);
};

/// A draw with its row: one number per column, in the units of these.
struct StudySample {
  std::uint64_t draw = 0;
  bool accepted = true;
  std::span<const double> row;
};

/// Draws of shard `shard` (from 0): a run of neighbours where the number of draws is given, else every shards-th one.
struct ShardDraws {
  std::uint64_t first = 0, step = 1, count = 0;  ///< count = 0: until enough are accepted
  std::uint64_t wanted = 0, most = 0;
};
ShardDraws shard_draws(const Study& study, int shard, int shards);

/// Computes one shard; `keep` gets its samples in order. `go_on` is asked between samples, with what is counted so far;
/// false ends it: nothing is returned then. After the last one it is told, too.
std::optional<StudyCounts> compute_shard(const Study& study, int shard, int shards,
                                         const std::function<void(const StudySample&)>& keep,
                                         const std::function<bool(const StudyCounts&)>& go_on = {});

/// All shards in memory, on several threads, for studies whose samples fit there; the numbers do not depend on how
/// many. `wanted`: places of the columns that are kept, in their order; all, if empty.
struct StudyTable {
  std::vector<std::uint64_t> draw;
  std::vector<char> accepted;
  std::vector<std::vector<double>> columns;  ///< those that are wanted, in their units
  StudyCounts counts;
};
StudyTable compute_study(const Study& study, int threads, std::vector<std::size_t> wanted = {});

}  // namespace hysteron
