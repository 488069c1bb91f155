// Decides, before anything is fitted, how long the fits of an effect at a place take. Internal to discover.
#pragma once

#include "discover/search/search_state.h"

namespace hysteron {

inline constexpr int slowest = 2;  ///< of slowness(): memory, or a past, inside a loop

/// 0: quick. Inside a loop each row is solved in steps, more so where something remembers there, and so are several
/// elements of memory in a block that moves.
int slowness(const SearchState& state, const TriedEffect& t);

}  // namespace hysteron
