// Decides whether a structure that no effect describes explains recordings better than the effects that were selected.
// Internal to discover.
#pragma once

#include <optional>

#include "discover/selection/selection.h"
#include "discover/structure/structure.h"

namespace hysteron {

/// All structures that were looked for in what the user's model leaves; the best of them is ahead.
struct StructureAhead {
  StructureSearch search;
  double by = 0;  ///< its score less that of the selected model
};

/// Structures on top of the user's model, as written or with its numbers let go, compete by the one score with the
/// selected model: nothing where none is ahead of it by more than a tie or none claims anything, and where the effects
/// would be claimed beside a structure (a law that is not all of it leaves one) or where the structure leaves more than
/// a tenth of what it explains itself.
std::optional<StructureAhead> structure_ahead(const SearchState& state, Selection& selection);

}  // namespace hysteron
