// Decides how two CSV files of traces are compared: what is printed, drawn and written. Does not measure
// (fit/compare/trace_distance.h).
#pragma once

#include "app/cli/verb.h"

namespace hysteron {

/// The verb compare for two CSV files. Returns the exit code: 1 where a tolerance is exceeded.
int compare_traces(const Arguments& arguments);

}  // namespace hysteron
