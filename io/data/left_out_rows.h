// Decides which rows of a recording are not judged though they lie between others that are: those that the data set
// excludes, and those in which a column stands at the end of its range. Does not read the data set (dataset_read.cpp).
#pragma once

#include <string>
#include <vector>

#include "io/data/dataset.h"

namespace hysteron {

/// A span of time since the first row [s].
struct ExcludedSpan {
  double from = 0, to = 0;
};

/// Leaves out the rows at which from <= time <= to.
void leave_out_spans(Recording& recording, const std::vector<ExcludedSpan>& spans);

/// Leaves out the rows at the limits of the columns. Returns a sentence for each column that lost rows.
std::vector<std::string> leave_out_clipped(Recording& recording, const std::map<std::string, ColumnNote>& notes);

}  // namespace hysteron
