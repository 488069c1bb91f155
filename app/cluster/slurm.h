// Decides how a study is handed to Slurm: which shards each task takes, the scripts on the disk, the two submissions,
// and what the user is told about them.
// Does not decide what stands in the scripts (slurm_script.h) nor what a shard is.
#pragma once

#include <string>

#include "app/cluster/slurm_script.h"

namespace hysteron {

/// The jobs as Slurm numbers them; "" where there was nothing to compute.
struct SlurmJobs {
  std::string shards, merge;
};

/// Throws Error "bad_slurm_options" for words that cannot stand in an #SBATCH line or that would undo the array.
void check_slurm_options(const std::string& options);

/// How many tasks an array may have here: asked of the cluster; Slurm's own default where nobody answers.
int most_slurm_tasks();

/// Throws Error "study_is_running" while jobs that an earlier submission from this folder made wait or run.
void refuse_second_submission(const std::string& folder);

/// shards.sh (where a shard is missing) and merge.sh, into study.folder, which is made.
void write_slurm_scripts(const SlurmStudy& study);

/// Submits both, the merge behind the shards. Throws Error "no_slurm", "slurm_refused"; then nothing is left submitted.
SlurmJobs submit_to_slurm(const SlurmStudy& study);

/// How to watch, read and stop the jobs.
std::string slurm_hints(const SlurmStudy& study, const SlurmJobs& jobs);

}  // namespace hysteron
