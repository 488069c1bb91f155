// Decides which jobs of a published work there are, and which of them the user means by chapters, figures and claims.
// Does not run them (published_runs.h).
#pragma once

#include <string>
#include <vector>

#include "app/jobs/job_runs.h"
#include "io/jobs/claims_file.h"

namespace hysteron {

struct PublishedJob {
  std::string file, name, chapter;
};

/// "diagrams" here or in a folder above; else where the program is installed.
/// Throws Error "no_folder".
std::string folder_of_jobs();

/// Every job with "do": "runs" below the folder; its chapter is the folder in which it lies.
/// Throws Error "no_folder", "no_jobs".
std::vector<PublishedJob> jobs_in(const std::string& folder);

/// What the user asked for: jobs, and the beginnings of the ids of claims that are told even without a job.
struct WantedJobs {
  std::vector<PublishedJob> jobs, others;
  std::vector<std::string> prefixes;
  bool claims_alone = true;  ///< nothing but claims was named: no others are told
};

/// `words`: chapters, figures, claims, "all". Throws Error "unknown_figure".
WantedJobs wanted_jobs(const std::vector<std::string>& words, const std::vector<PublishedJob>& all,
                       const std::vector<PublishedClaim>& claims, JobPool& pool);

}  // namespace hysteron
