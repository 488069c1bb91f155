// Decides which numbers a job may take from a formula instead of a run ("take": "computed"): claims on formulas of the
// thesis. Their parameters are those of its tables.
#pragma once

#include "app/jobs/job_runs.h"

namespace hysteron {

/// Throws Error "unknown_figure" with the nearest name.
Quantity computed(const WrittenText& name);

}  // namespace hysteron
