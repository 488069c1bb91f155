// Decides how two CSV files of traces are compared: what is said, drawn and written. Does not measure
// (fit/compare/trace_distance.h).
#pragma once

#include "app/cli/answer.h"

namespace hysteron {

/// The verb compare for two CSV files. Exit code 1 where a tolerance is exceeded.
Answer compare_traces(const Arguments& arguments);

}  // namespace hysteron
