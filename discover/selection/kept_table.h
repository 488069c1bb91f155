// Decides what is kept of the models that a selection has fitted. Internal to discover.
#pragma once

#include <vector>

#include "discover/selection/selection.h"

namespace hysteron {

/// Of each round what it stood on, and each rival by its best law; in the first round the user's model as written and
/// with its numbers let go.
std::vector<FittedModel> table_of(const SearchState& state, const Selection& selection);

}  // namespace hysteron
