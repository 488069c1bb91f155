// Decides which rows of a data set are wrong by themselves: gaps of the clock, rows that were lost or repeat, single
// values far from all others, outputs that stay at their end.
#pragma once

#include <vector>

#include "fit/inspect/inspected_rows.h"
#include "fit/inspect/inspection.h"

namespace hysteron {

/// Adds what is found to `seen.faults`, `seen.notes` and `seen.spoiling`; `seen` has its columns and recordings
/// already, the latter one for each of `parts`.
void find_row_faults(const DataModel& model, const std::vector<InspectedPart>& parts, Inspection& seen);

}  // namespace hysteron
