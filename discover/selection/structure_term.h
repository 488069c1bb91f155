// Decides whether a structure that no effect describes explains recordings better than the effects that were selected.
// Internal to discover.
#pragma once

#include <optional>

#include "discover/selection/selection.h"
#include "discover/structure/structure.h"

namespace hysteron {

/// Structures on top of the user's model, as written or with its numbers let go, compete by the one score with the
/// selected model. The best of them is told in place of the effects where it is ahead of them by more than a tie and
/// claims something; not where the effects would be claimed beside it (a law that is not all of it leaves a structure),
/// where it leaves more than a tenth of what it explains itself, or where it is a line or a ripple that one of the
/// effects looks for. Nothing where there is no structure.
std::optional<CompetingStructure> structure_beside_effects(SearchState& state, Selection& selection);

}  // namespace hysteron
