// Decides what a cluster that runs Slurm is asked to do: the two batch scripts of a study, whole and readable.
// Does not submit them (slurm.h), nor does it know how a shard is computed.
#pragma once

#include <string>
#include <vector>

namespace hysteron {

/// A study cut into shards 1 ... `shards`; task t of the array computes the shards t, t + tasks, t + 2 tasks ...
struct SlurmStudy {
  std::string title;                     ///< said in a comment and as the name of the jobs
  std::vector<std::string> shard_words;  ///< program and words that compute a shard; "--shard K/N" is put behind them
  std::vector<std::string> merge_words;  ///< program and words that join the shards
  std::string folder;                    ///< where the scripts and their logs lie: absolute
  std::string options;                   ///< words for sbatch, as the user wrote them ("--partition=short")
  int shards = 1;
  int tasks = 1;             ///< at most `shards`
  std::vector<int> missing;  ///< shards still to be computed, ascending
};

/// How often a task that was killed asks to be started again.
inline constexpr int most_restarts = 5;

/// The tasks that have a shard to compute, as sbatch --array wants them: "1-4,7". "" where none is missing.
std::string array_of_tasks(const SlurmStudy& study);

std::string shards_script(const SlurmStudy& study);
std::string merge_script(const SlurmStudy& study);

}  // namespace hysteron
