// Decides whether the names that a job of runs gives fit together: every run and value that is named is there, and none
// needs itself. Internal to io.
#pragma once

#include "io/jobs/runs_job.h"
#include "io/json/json_reader.h"

namespace hysteron {

/// Notes "unknown_run" and "unknown_value", each with the nearest name that there is.
void check_names(JsonFile& file, const RunsJob& job);
/// Notes "circular" where a run or a value needs itself; for a job whose names are all known.
void check_circles(JsonFile& file, const RunsJob& job);

}  // namespace hysteron
