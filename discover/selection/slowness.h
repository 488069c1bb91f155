// Decides, before anything is fitted, how long the fits of an effect at a place take. Internal to discover.
#pragma once

#include "discover/search/search_state.h"

namespace hysteron {

inline constexpr int slowest = 2;  ///< of slowness(): memory, or a past, inside a loop

/// 0: quick. Inside a loop each row is solved in steps, more so where something remembers there, and so are several
/// elements of memory in a block that moves.
int slowness(const SearchState& state, const TriedEffect& t);

/// Does the law change modes inside a loop, as dry friction does? No row is passed there at once, each stop is located:
/// ten times as slow as by a law of the effect that is smooth, which says first whether it may be that effect.
bool stops_in_a_loop(const SearchState& state, const TriedEffect& t, const Law& law);

}  // namespace hysteron
