// Decides how the jobs of a published work are run: several runs at once, watched; what one of them gave.
// Does not decide which (published_jobs.h) nor what is told of them.
#pragma once

#include <exception>
#include <string>
#include <vector>

#include "app/cli/watch.h"
#include "app/jobs/claims.h"
#include "app/jobs/job_figures.h"
#include "app/jobs/published_jobs.h"

namespace hysteron {

/// What one job gave. A run whose numerics failed costs its job alone; wrong input ends everything.
struct JobDone {
  JobPage page;
  std::vector<PartOutcome> parts;
  std::string failed{};
  std::exception_ptr error{};
  double seconds = 0;
};

/// All jobs, several runs at once; what comes out does not depend on how many.
std::vector<JobDone> run_all(const std::vector<PublishedJob>& jobs, JobPool& pool, const Watch& watch);

}  // namespace hysteron
