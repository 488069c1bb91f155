// Decides what "hysteron study --slurm" does: checks the study here, and hands what is missing of it to a cluster.
// Does not decide what the cluster is asked to do (slurm_script.h) nor how it is asked (slurm.h).
#pragma once

#include <string>
#include <vector>

#include "app/cli/answer.h"
#include "app/study/study_shards.h"

namespace hysteron {

/// --slurm and what belongs to it.
std::vector<OptionSpec> slurm_options();

bool wants_slurm(const Arguments& arguments);

/// `folder` is open. `words`: what the user said that belongs to every shard and to the merge ("--set", "a=1");
/// `merge_words`: what belongs to the merge alone ("--csv").
Answer submit_study(const Arguments& arguments, const std::string& job, const std::string& title,
                    const StudyFolder& folder, const std::vector<std::string>& words,
                    const std::vector<std::string>& merge_words);

}  // namespace hysteron
