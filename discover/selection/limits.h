// Decides how large an effect can be that was looked for and not found. Internal to discover.
#pragma once

#include "discover/selection/selection.h"

namespace hysteron {

/// Fills Discovery::limits: for each effect that could have been seen and is not in the selected model, at the place
/// where these recordings allow most of it, the size that it has at most, in 95 of 100 cases. Sizes are those numbers
/// of the effect's first law that LawParameter::is_size marks, all of them in proportion to where they start; what
/// else the law has stays where it starts.
///
/// With r what the model leaves, weighed as the score does, and d what one size takes away, r = a d + J b + noise of
/// variance one: b are the user's numbers, each known to 10 % or to what the diagram says, what is free in the diagram
/// and the laws that stand, and what else makes up for the effect. The limit is |a| + 1.645 sigma(a), with no less than
/// 0 for what cannot be negative; d is what the effect does at that size, until both agree.
///
/// Nothing where more than noise is left: what is missing there may be any of them.
void tell_limits(SearchState& state, const Selection& selection, Discovery& d);

}  // namespace hysteron
