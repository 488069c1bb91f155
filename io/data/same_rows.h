// Decides which recordings would judge a model by the very rows that it was fitted to. Does not forbid it.
#pragma once

#include <string>
#include <vector>

#include "io/data/dataset.h"

namespace hysteron {

/// A sentence for each recording of the role validate or test whose rows are those of one that trains: one file listed
/// twice, or a copy of it. Parts of one recording that do not overlap are none.
std::vector<std::string> warnings_of_same_rows(const DataSet& data);

}  // namespace hysteron
