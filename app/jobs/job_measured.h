// Decides how the values that a job measures are laid out: runs below each other, what was measured beside each other.
// Does not measure (job_runs.h).
#pragma once

#include <vector>

#include "app/jobs/job_runs.h"
#include "io/results/result.h"

namespace hysteron {

/// Values taken from runs, a row for each run; then those that combine others. No table where there is none.
std::vector<Table> measured_tables(JobRunner& runner);

}  // namespace hysteron
